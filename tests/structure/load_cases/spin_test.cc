// Rotation as a load, against closed forms.
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

constexpr double bar_modulus = 2e11, bar_density = 7850, bar_spin = 100;  // Pa, kg/m^3, rad/s
constexpr double bar_radius = 2;      // m, from the axis to the free end
const Vector3 axis_place(3, 1, 0.5);  // m

ElasticModel model_of_spin(const Deck& deck) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  return {std::move(mesh), {3, {}}};
}

/// Displacement along x of the node of a label, m.
double pulled_out(const ElasticModel& model, const DeckCaseSolution& found, long label) {
  const auto& labels = model.mesh().vertex_labels;
  for (std::size_t v = 0; v < labels.size(); ++v)
    if (labels[v] == label)
      return found.motion[6L * model.space().node_of_vertex(static_cast<int>(v))];
  return std::nan("");
}

const std::string bar_material = "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, 0.\n*DENSITY\n7850.,\n";
const std::string bar_turning =
    "*STEP\n*STATIC\n*DLOAD\n, CENTRIF, 10000., 3., 1., 0.5, 0., 0., 2.\n*END STEP\n";

/// A bar from the axis outwards of each kind; node 2 is at its free end.
std::string turned_beam() {
  return "*NODE\n1, 3., 1., 0.5\n2, 5., 1., 0.5\n*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n" +
         bar_material +
         "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.1, 0.05\n0., 0., 1.\n*BOUNDARY\n"
         "1, 1, 6\n" +
         bar_turning;
}
std::string turned_plate() {
  return "*NODE\n1, 3., 0.9, 0.5\n2, 5., 0.9, 0.5\n3, 5., 1.1, 0.5\n4, 3., 1.1, 0.5\n"
         "*ELEMENT, TYPE=S4, ELSET=E\n1, 1, 2, 3, 4\n" +
         bar_material +
         "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.02\n*BOUNDARY\n1, 1, 1\n4, 1, 1\n1, 2, 6\n" +
         bar_turning;
}
std::string turned_solid(int n) {
  std::string text = "*NODE\n";
  const auto node = [](int i, int corner) { return i == 0 ? 10 + corner : 4 * i + corner + 20; };
  for (int i = 0; i <= n; ++i)
    for (int corner = 0; corner < 4; ++corner)
      text += fmt::format("{}, {:.8g}, {:.8g}, {:.8g}\n",
                          i == n && corner == 0 ? 2 : node(i, corner), 3 + bar_radius * i / n,
                          corner == 1 || corner == 2 ? 1.1 : 0.9, corner >= 2 ? 0.6 : 0.4);
  text += "*ELEMENT, TYPE=C3D8, ELSET=E\n";
  for (int i = 0; i < n; ++i) {
    text += fmt::format("{}", i + 1);
    for (const int end : {i, i + 1})
      for (int corner = 0; corner < 4; ++corner)
        text += fmt::format(", {}", end == n && corner == 0 ? 2 : node(end, corner));
    text += "\n";
  }
  return text + bar_material +
         "*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\n10, 1, 3\n11, 1, 1\n12, 1, 1\n13, 1, 1\n"
         "11, 3, 3\n" +
         bar_turning;
}

// A bar about one end: u = rho w^2 L^3 / (3 E), rho w^2 L^2 / 2 at the axis. Shells and beams of
// degree 3 have its curve, quadratic solids come near.
TEST(Spin, BarsOfEachKindAreDrawnOut) {
  const double end =
      bar_density * bar_spin * bar_spin * std::pow(bar_radius, 3) / (3 * bar_modulus);
  const double stress = bar_density * bar_spin * bar_spin * bar_radius * bar_radius / 2;
  const struct {
    std::string text;
    double tolerance;
  } bars[] = {{turned_beam(), 1e-6}, {turned_plate(), 1e-4}, {turned_solid(6), 5e-3}};
  for (const auto& [text, tolerance] : bars) {
    const Deck deck = test::abaqus(text);
    ASSERT_EQ(deck.load_sets.size(), 1U);
    ASSERT_EQ(deck.load_sets[0].spins.size(), 1U);
    const ElasticModel model = model_of_spin(deck);
    const DeckSolution solution = solve_deck(model, deck, 1);
    ASSERT_EQ(solution.cases.size(), 1U);
    EXPECT_NEAR(pulled_out(model, solution.cases[0], 2), end, tolerance * end);
    EXPECT_NEAR(solution.cases[0].stress.peak_von_mises.value, stress, 0.03 * stress);
    // The axis holds the whole centrifugal force: m w^2 times the centre's distance.
    const double mass = model.mass_properties().mass;
    EXPECT_NEAR(solution.cases[0].supported.force.x(), -mass * bar_spin * bar_spin * bar_radius / 2,
                1e-5 * mass * bar_spin * bar_spin);
  }
}

std::string nastran_plate(const std::string& loads) {
  return "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,1,,3.,0.9,0.5\nGRID,2,,5.,0.9,0.5\n"
         "GRID,3,,5.,1.1,0.5\nGRID,4,,3.,1.1,0.5\nGRID,9,,3.,1.,0.5\nCQUAD4,1,1,1,2,3,4\n"
         "PSHELL,1,1,0.02,1,,1\nMAT1,1,2.+11,,0.,7850.\nSPC1,1,1,1,4\nSPC1,1,23456,1\n" +
         loads + "ENDDATA\n";
}

// RFORCE has revolutions: 100 rad/s are 15.915 of them. Its angular acceleration pulls along.
TEST(Spin, NastranCountsRevolutions) {
  const double revolutions = bar_spin / (2 * std::numbers::pi);
  const Deck deck = test::nastran(nastran_plate(fmt::format(
      "RFORCE,2,9,0,{:.12g},0.,0.,1.,2\n,{:.12g}\n", revolutions / 2, 2 * revolutions)));
  ASSERT_EQ(deck.load_sets.at(0).spins.size(), 1U);
  const Spin& read = deck.load_sets[0].spins[0];
  EXPECT_LT((read.place - axis_place).norm(), 1e-12);
  EXPECT_LT((read.velocity - Vector3(0, 0, bar_spin / 2)).norm(), 1e-9);
  EXPECT_LT((read.acceleration - Vector3(0, 0, 2 * bar_spin)).norm(), 1e-9);
  const ElasticModel model = model_of_spin(deck);
  const DeckSolution solution = solve_deck(model, deck, 1);
  const double mass = model.mass_properties().mass;
  // Along x w^2 r, along y a r, r the middle's distance.
  EXPECT_NEAR(solution.cases[0].applied.force.x(), mass * bar_spin * bar_spin / 4,
              1e-6 * mass * bar_spin);
  EXPECT_NEAR(solution.cases[0].applied.force.y(), mass * 2 * bar_spin, 1e-6 * mass * bar_spin);
}

TEST(Spin, IsWrittenAndReadAgain) {
  const Deck deck = test::abaqus(turned_plate());
  for (const Deck& again : {test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))}) {
    const ElasticModel model = model_of_spin(again);
    const DeckSolution solution = solve_deck(model, again, 1);
    ASSERT_EQ(solution.cases.size(), 1U);
    const double mass = model.mass_properties().mass;
    EXPECT_NEAR(solution.cases[0].applied.force.x(), mass * bar_spin * bar_spin,
                1e-6 * mass * bar_spin * bar_spin);
    EXPECT_NEAR(solution.cases[0].applied.force.y(), 0, 1e-6 * mass * bar_spin * bar_spin);
  }
}

TEST(Spin, WhatIsNotKnownIsRefused) {
  std::string text = turned_plate();
  const std::string load = ", CENTRIF, 10000., 3., 1., 0.5, 0., 0., 2.";
  const auto with = [&](const std::string& other) {
    std::string changed = text;
    return test::complaints_of_abaqus(changed.replace(changed.find(load), load.size(), other));
  };
  EXPECT_THAT(with(", CENTRIF, 10000., 3., 1., 0.5"), HasSubstr("no direction of its axis"));
  EXPECT_THAT(with(", CENTRIF, -1., 3., 1., 0.5, 0., 0., 1."), HasSubstr("not negative"));
  EXPECT_THAT(test::complaints_of_nastran(nastran_plate("RFORCE,2,9,0,1.,0.,0.,1.,2\n,,,5\n")),
              HasSubstr("rotation of all is due"));
}

}  // namespace
}  // namespace blocklift::structure
