// How far panels leave the force of waves off, beside what they leave of radiation.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/database_parts.h"

namespace blocklift::dynamics {
namespace {

// Of 3 + 4i and 2 heave has 5 at most; sway has a ten-thousandth of that, which is nothing.
TEST(ExcitationChange, IsTheLargestDifferenceOfTheLargestForce) {
  HydrodynamicDatabase database;
  database.body_names = {"box"};
  database.frequencies = {1.0, 2.0};
  database.headings = {0.0};
  database.froude_krylov.assign(2, Eigen::MatrixXcd::Zero(6, 1));
  database.diffraction = database.froude_krylov;
  database.damping.assign(2, Eigen::MatrixXd::Zero(6, 6));
  database.added_mass = database.damping;
  database.froude_krylov[0](heave, 0) = 3.0;
  database.diffraction[0](heave, 0) = {0.0, 4.0};
  database.diffraction[1](heave, 0) = 2.0;
  database.diffraction[1](sway, 0) = 5e-4;
  database.diffraction[1](roll, 0) = {0.0, 0.1};
  CoarserForces coarser(6, 2, 1);
  coarser.diffraction = database.diffraction;
  coarser.diffraction[0](heave, 0) = {0.0, 3.5};
  coarser.diffraction[1](heave, 0) = {2.0, 1.0};
  coarser.diffraction[1](sway, 0) = 0.0;
  // Turned by a right angle alone: the phase counts.
  coarser.diffraction[1](roll, 0) = 0.1;
  const Eigen::VectorXd change = largest_excitation_change(database, coarser);
  ASSERT_EQ(change.size(), 6);
  EXPECT_NEAR(change[heave], 1.0 / 5.0, 1e-12);
  EXPECT_NEAR(change[roll], std::sqrt(2.0), 1e-12);
  EXPECT_EQ(change[sway], 0.0);
  EXPECT_EQ(change[surge], 0.0);
  coarser.diffraction[0].setConstant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isinf(largest_excitation_change(database, coarser)[heave]));
  database.headings.clear();
  EXPECT_EQ(largest_excitation_change(database, coarser).size(), 0);
}

// In deep water mean |X|^2 is 4 rho g c_g B/k = 2 rho g^3 B/w^3 = 36 N2/m2 here. Waves along the
// plane of symmetry leave 3 of these 6, of which 1.2 changes. Damping of a thousandth of the force
// tells nothing.
TEST(ExcitationChange, IsOfTheMeanForceWhereTheseWavesExertLess) {
  HydrodynamicDatabase database;
  database.water = {1.0, 9.0};
  database.body_names = {"box"};
  database.frequencies = {1.0};
  database.headings = {0.0};
  database.froude_krylov.assign(1, Eigen::MatrixXcd::Zero(6, 1));
  database.diffraction = database.froude_krylov;
  database.damping.assign(1, Eigen::MatrixXd::Zero(6, 6));
  database.added_mass = database.damping;
  const double damping = 36.0 / (2.0 * 729.0);
  for (const int mode : {sway, heave}) {
    database.diffraction[0](mode, 0) = 3.0;
    database.damping[0](mode, mode) = damping;
  }
  database.added_mass[0](sway, sway) = 10.0 * damping;
  database.added_mass[0](heave, heave) = 1000.0 * damping;
  EXPECT_NEAR(calc_mean_excitation(database)[sway], 6.0, 1e-9);
  EXPECT_EQ(calc_mean_excitation(database)[heave], 0.0);
  CoarserForces coarser(6, 1, 1);
  coarser.diffraction[0] = 0.6 * database.diffraction[0];
  const Eigen::VectorXd change = largest_excitation_change(database, coarser);
  EXPECT_NEAR(change[sway], 1.2 / 6.0, 1e-9);
  EXPECT_NEAR(change[heave], 1.2 / 3.0, 1e-12);
}

/// A hull that turns about the world's origin, in five waves, the shortest of a frequency (rad/s).
HydrodynamicDatabase compute_hull(const PanelMesh& hull, double highest,
                                  const std::vector<double>& headings, const Symmetry& symmetry) {
  const Water water{1000.0, 9.80665};
  const std::vector<WettedBody> bodies{{"box", hull, Vector3::Zero()}};
  DatabaseSettings settings;
  for (const double less : {0.8, 0.6, 0.4, 0.2, 0.0})
    settings.frequencies.push_back(highest - less);
  settings.headings = headings;
  settings.with_coarser = true;
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  const auto lines = find_water_lines(bodies);
  const SurfaceMesh surface = make_surface_mesh(
      lines, surface_settings(lines, length(highest), length(settings.frequencies.front())));
  return compute_database({bodies, surface, water, symmetry}, settings);
}

/// A box of 20 x 10 m that draws 3 m, and turns about the water line.
HydrodynamicDatabase compute_box(const BoxDivision& division) {
  return compute_hull(make_box_hull(20.0, 10.0, 3.0, division), 1.4,
                      {0.0, std::numbers::pi / 6.0, std::numbers::pi / 3.0, std::numbers::pi / 2.0},
                      {true, true});
}

/// A barge of 40 x 16 m that draws 4 m; panels on its port side are cut into triangles.
PanelMesh make_uneven_barge() {
  std::vector<Panel> panels;
  const PanelMesh even =
      make_box_hull(40.0, 16.0, 4.0, {.length = 10, .breadth = 4, .draught = 1, .grading = 1.0});
  for (const Panel& panel : even.panels) {
    if (panel.centroid.y() < 0.0) {
      panels.push_back(panel);
      continue;
    }
    const auto& corners = panel.vertices;
    panels.push_back(make_panel(std::array{corners[0], corners[1], corners[2]}));
    panels.push_back(make_panel(std::array{corners[0], corners[2], corners[3]}));
  }
  return make_panel_mesh(panels);
}

// Waves from ahead press next to nothing across the barge; what there is are the panels.
TEST(ExcitationChange, OfPanelsThatAreNotSymmetricIsNoAlarmInHeadSea) {
  std::vector<double> around;
  for (int h = 0; h < 36; ++h) around.push_back(std::numbers::pi / 18.0 * h);
  const PanelMesh barge = make_uneven_barge();
  const HydrodynamicDatabase head = compute_hull(barge, 1.4, {0.0}, {});
  const HydrodynamicDatabase all = compute_hull(barge, 1.4, around, {});
  const Eigen::VectorXd means = calc_mean_excitation(all);
  for (const int mode : {sway, roll, yaw}) {
    double largest = 0.0, mean = 0.0, left = 0.0;
    for (std::size_t k = 0; k < all.frequencies.size(); ++k) {
      const Eigen::VectorXd forces = all.excitation(k).row(mode).cwiseAbs().transpose();
      mean = std::max(mean, std::sqrt(forces.squaredNorm() / 36.0));
      largest = std::max(largest, forces.maxCoeff());
      left = std::max(left, std::abs(head.excitation(k)(mode, 0)));
    }
    std::printf(
        "mode %d: of the largest force, head sea %.4f, mean %.3f, by damping %.3f; changes "
        "by %.3f in head sea, by %.3f in all\n",
        mode, left / largest, mean / largest, means[mode] / largest,
        head.excitation_change_from_coarser[mode], all.excitation_change_from_coarser[mode]);
    // Panels of 4 m know roll's damping badly.
    EXPECT_NEAR(means[mode], mean, (mode == roll ? 0.3 : 0.05) * mean) << mode;
    EXPECT_GT(left, 5e-3 * largest) << mode;
    EXPECT_LT(left, 0.06 * largest) << mode;
    EXPECT_LT(head.excitation_change_from_coarser[mode], all.excitation_change_from_coarser[mode])
        << mode;
  }
}

// The moment of waves about the long axis is the small rest of what they do to bottom and sides:
// panels of 2 m miss half of it where the radiation force on roll is known to a tenth.
TEST(ExcitationChange, TellsOfRoll) {
  const HydrodynamicDatabase coarse =
      compute_box({.length = 10, .breadth = 6, .draught = 2, .grading = 1.0});
  const HydrodynamicDatabase fine =
      compute_box({.length = 20, .breadth = 12, .draught = 4, .grading = 1.0});
  const Eigen::VectorXd& change = coarse.excitation_change_from_coarser;
  ASSERT_EQ(change.size(), 6);
  for (int mode = 0; mode < modes_per_body; ++mode) {
    double error = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < coarse.frequencies.size(); ++k) {
      const Eigen::RowVectorXcd X = coarse.excitation(k).row(mode);
      error = std::max(error, (X - fine.excitation(k).row(mode)).cwiseAbs().maxCoeff());
      largest = std::max(largest, X.cwiseAbs().maxCoeff());
    }
    std::printf("mode %d: error %.3f, estimated %.3f\n", mode, error / largest, change[mode]);
    EXPECT_GT(change[mode], error / largest) << mode;
    if (mode != roll) continue;
    EXPECT_GT(error / largest, 0.2);
    EXPECT_GT(change[roll], 0.2);
  }
  EXPECT_LT(coarse.change_from_coarser[roll], change[roll]);
}

}  // namespace
}  // namespace blocklift::dynamics
