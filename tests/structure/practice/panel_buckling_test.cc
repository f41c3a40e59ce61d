// Buckling of plate panels.
#include "structure/practice/panel_buckling.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "structure/mesh/plates/block_generator.h"

namespace blocklift::structure {
namespace {

const Material steel{"AH36", 206e9, 0.3, 7850, 355e6};

// Timoshenko and Gere (1961), Theory of Elastic Stability, table 9-1: k of a simply supported plate under
// uniform compression by a/b.
TEST(PanelBuckling, HasTheCoefficientsOfTimoshenkoAndGere) {
  const double table[][2] = {{0.4, 8.41}, {0.6, 5.14}, {0.8, 4.20}, {1.0, 4.00},
                             {1.2, 4.13}, {1.4, 4.47}, {1.6, 4.20}, {2.0, 4.00}};
  for (const auto& [ratio, k] : table)
    EXPECT_NEAR(compression_coefficient(ratio, 1, 1, 0), k, 0.006) << ratio;
  // Table 9-6: bending alone (psi = -1) 23.9 at a/b = 1 and 2; linear to zero (psi = 0) 7.8 at a/b = 1. The
  // rules' formulae are fits to it.
  EXPECT_NEAR(compression_coefficient(2, 1, -1, 0), 23.9, 0.02 * 23.9);
  EXPECT_NEAR(compression_coefficient(1, 1, 0, 0), 7.8, 0.03 * 7.8);
  // Section 9.7, shear: 5.34 + 4 (b/a)^2, 9.34 of a square.
  EXPECT_NEAR(shear_coefficient(1, 1, false), 9.34, 1e-12);
  EXPECT_NEAR(shear_coefficient(1, 1000, false), 5.34, 1e-5);
  // Section 9.4, one edge free: 1.44 at a/b = 1, 0.516 at 4 (table 9-4); the formula drops a term.
  EXPECT_NEAR(compression_coefficient(1, 1, 1, 1), 1.44, 0.02 * 1.44);
  EXPECT_NEAR(compression_coefficient(4, 1, 1, 1), 0.516, 0.06 * 0.516);
}

// A wide column is Euler's column of the plate's bending stiffness: sigma = pi^2 D / (L^2 t).
TEST(PanelBuckling, WideColumnIsEulers) {
  const double t = 0.01, length = 1.5;
  const double d = steel.youngs_modulus * t * t * t / 12 / (1 - 0.09);
  const double sigma = compression_coefficient(length, 3, 1, 2) * euler_stress(steel, t, 3);
  EXPECT_NEAR(sigma, std::numbers::pi * std::numbers::pi * d / (length * length * t), 1e-6 * sigma);
}

TEST(PanelBuckling, JohnsonAndOstenfeldTakeOverAtHalfTheYieldStress) {
  EXPECT_DOUBLE_EQ(johnson_ostenfeld(100e6, 355e6), 100e6);
  EXPECT_DOUBLE_EQ(johnson_ostenfeld(177.5e6, 355e6), 177.5e6);
  const double h = 1;  // Pa: the slope is that of the elastic branch there
  EXPECT_NEAR((johnson_ostenfeld(177.5e6 + h, 355e6) - 177.5e6) / h, 1, 1e-6);
  EXPECT_NEAR(johnson_ostenfeld(355e6, 355e6), 0.75 * 355e6, 1);
  EXPECT_NEAR(johnson_ostenfeld(1e15, 355e6), 355e6, 1e2);
}

TEST(PanelBuckling, UtilisationIsHomogeneousAndPassesTensionOver) {
  const PanelSize size{4, 0.8, 0.014};
  PanelStress stress{-60e6, -20e6, 30e6, 10e6, 5e6};
  const BucklingUtilisation one = buckling_utilisation(size, {}, steel, stress);
  EXPECT_GT(one.critical, one.elastic);  // thick: yielding counts
  PanelStress twice{-120e6, -40e6, 60e6, 20e6, 10e6};
  EXPECT_NEAR(buckling_utilisation(size, {}, steel, twice).critical, 2 * one.critical, 1e-12);
  EXPECT_EQ(buckling_utilisation(size, {}, steel, {50e6, 20e6, 0, 10e6, 5e6}).critical, 0);
  // Uniform compression alone: the stress over Bryan's.
  const double bryan = 4 * euler_stress(steel, 0.014, 0.8);
  EXPECT_NEAR(buckling_utilisation(size, {}, steel, {-60e6, 0, 0, 0, 0}).elastic, 60e6 / bryan,
              1e-12);
}

// A box of 4 x 2 x 1 m with one frame and a web that hangs free below its deck.
BlockDescription box() {
  BlockDescription block;
  block.name = "box";
  block.materials = {steel};
  const std::array<Interval, 3> all = {{{0, 4}, {0, 2}, {0, 1}}};
  block.plates = {{"bottom", Axis::z, {0}, all, 0.012, "AH36"},
                  {"deck", Axis::z, {1}, all, 0.010, "AH36"},
                  {"ends", Axis::x, {0, 2, 4}, all, 0.010, "AH36"},
                  {"sides", Axis::y, {0, 2}, all, 0.010, "AH36"},
                  {"web", Axis::y, {1}, {{{0, 4}, {0, 2}, {0.7, 1}}}, 0.010, "AH36"}};
  block.largest_element = 1;
  return block;
}

TEST(BlockPanels, AreTheFieldsBetweenCrossingPlates) {
  const ElasticModel model = make_elastic_model(box(), 2);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(model.unknowns(), 1);
  const BlockPanels panels(model, none, {{"bottom", 0, 0.5}});
  int decks = 0, webs = 0, bottoms = 0;
  for (const Panel& panel : panels.panels()) {
    if (panel.group == "deck") {
      ++decks;  // divided by the web and the middle frame
      EXPECT_NEAR(panel.size.a, 2, 0.02);
      EXPECT_NEAR(panel.size.b, 1, 0.02);
      EXPECT_EQ(panel.free.along_a + panel.free.along_b, 0);
      EXPECT_DOUBLE_EQ(panel.size.thickness, 0.010);
    } else if (panel.group == "web") {
      ++webs;
      EXPECT_EQ(panel.free.along_a + panel.free.along_b, 1);
    } else if (panel.group == "bottom") {
      ++bottoms;
      EXPECT_EQ(panel.fields_b, 4);
      EXPECT_EQ(panel.fields_a, 1);
    }
  }
  EXPECT_EQ(decks, 4);
  EXPECT_EQ(webs, 2);
  EXPECT_EQ(bottoms, 2);
}

// A displacement with a known stress: u = (c x + d x y, -(nu) c y, 0) ... taken as a plane state whose
// mean and gradients are what Hooke's law gives.
TEST(BlockPanels, MeanAndGradientOfALinearStressAreExact) {
  const ElasticModel model = make_elastic_model(box(), 2);
  Eigen::MatrixXd u(model.unknowns(), 1);
  const double c = 1e-4, d = 3e-5;
  for (int n = 0; n < model.space().node_count(); ++n) {
    const Vector3 x = model.space().nodes.col(n);
    u.block<3, 1>(3 * n, 0) = Vector3(c * x.x() + d * x.x() * x.y(), -d * x.x() * x.x() / 2, 0);
  }
  const BlockPanels panels(model, u, {});
  const auto found = panels.stresses(Eigen::VectorXd::Ones(1));
  const double modulus = steel.lame_lambda() + 2 * steel.shear_modulus();
  int seen = 0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Panel& panel = panels.panels()[p];
    if (panel.group != "deck") continue;
    ++seen;  // in-plane axes x, y; du/dx = c + d y, no shear
    EXPECT_NEAR(found[p].s11, modulus * (c + d * panel.centre_B.y()), 1);
    EXPECT_NEAR(std::abs(found[p].s11_gradient), modulus * d * panel.size.b / 2, 1);
    EXPECT_NEAR(found[p].s12, 0, 1);
    EXPECT_NEAR(found[p].s22_gradient, 0, 1);
  }
  EXPECT_EQ(seen, 4);
}

}  // namespace
}  // namespace blocklift::structure
