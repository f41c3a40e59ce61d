// Equations that hold a deck's whole, against bars in closed form.

#include <cmath>
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

constexpr double stretch_stiffness = 1e8;  // E A / L of a bar of 0.001 m2 and 2 m, N/m
constexpr double bend_stiffness = 7.5e4;   // 3 E I / L^3 of 1e-6 m4, N/m

const std::string case_control = "SOL 101\nCEND\nSPC = 1\nMPC = 3\nLOAD = 2\nBEGIN BULK\n";
const std::string bar_on_slope =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,.001,1.-6,1.-6,1.-6\n"
    "MAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1\nFORCE,2,2,,1000.,0.,0.,1.\n";
/// Two bars side by side, the second of twice the area; the first is pulled by 300 kN.
const std::string two_bars =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,2.,1.,0.\n"
    "CBAR,1,1,1,2,0.,0.,1.\nCBAR,2,2,3,4,0.,0.,1.\nPBAR,1,1,.001,1.-6,1.-6,1.-6\n"
    "PBAR,2,1,.002,1.-6,1.-6,1.-6\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1,3\n"
    "FORCE,2,2,,3.+5,1.,0.,0.\n";

struct Held {
  explicit Held(const Deck& deck) : model(mesh_of(deck), {3, {}}) {
    solution = solve_deck(model, deck, 1);
  }
  static Mesh mesh_of(const Deck& deck) {
    Mesh mesh = deck.mesh;
    for (Material& material : mesh.materials) material.yield_stress = 235e6;
    return mesh;
  }
  Vector3 motion(int vertex) const {
    return solution.cases.at(0).motion.segment<3>(6L * model.space().node_of_vertex(vertex));
  }
  SupportReaction reaction(int vertex) const {
    for (const SupportReaction& one : solution.cases.at(0).reactions)
      if (one.vertex == vertex) return one;
    return {};
  }

  ElasticModel model;
  DeckSolution solution;
};

// The end of a cantilever runs on a slope of 30 degrees: w = u tan a, and the slope's force is
// across it. u (E A / L + 3 E I / L^3 tan^2 a) = P tan a.
TEST(HoldingEquations, RollersOnASlope) {
  const double s = 0.5, c = std::sqrt(0.75);
  const Deck deck =
      test::nastran(case_control + bar_on_slope +
                    fmt::format("MPC,3,2,3,{:.15g},2,1,{:.15g}\n", c, -s) + "ENDDATA\n");
  ASSERT_EQ(deck.holding_equations.size(), 1U);
  for (const Deck& one : {deck, test::nastran(to_nastran(deck)), test::abaqus(to_abaqus(deck))}) {
    const Held held(one);
    const double slope = s / c;
    const double along = 1000 * slope / (stretch_stiffness + bend_stiffness * slope * slope);
    EXPECT_NEAR(held.motion(1).x(), along, 1e-6 * along);
    EXPECT_NEAR(held.motion(1).z(), along * slope, 1e-6 * along);
    const Vector3 force = held.reaction(1).force;
    EXPECT_NEAR(force.x(), stretch_stiffness * along, 1e-5 * force.norm());
    EXPECT_NEAR(force.dot(Vector3(c, 0, s)), 0, 1e-6 * force.norm());
    EXPECT_LT(held.solution.cases[0].force_residual, 1e-8);
    EXPECT_LT(held.solution.cases[0].moment_residual, 1e-8);
  }
}

// Ends that move along x together, or against each other, share the force by their stiffness: the
// equation pulls the second bar with two thirds of it.
TEST(HoldingEquations, FacesThatStayParallelAndSkewSymmetry) {
  for (const double sign : {1.0, -1.0}) {
    const Deck deck = test::nastran(case_control + two_bars +
                                    fmt::format("MPC,3,2,1,1.,4,1,{:.1f}\nENDDATA\n", -sign));
    ASSERT_EQ(deck.holding_equations.size(), 1U);
    EXPECT_TRUE(deck.mesh.equations.empty());
    const Held held(deck);
    EXPECT_NEAR(held.motion(1).x(), 1e-3, 1e-9);
    EXPECT_NEAR(held.motion(3).x(), sign * 1e-3, 1e-9);
    EXPECT_NEAR(held.reaction(1).force.x(), -2e5, 1);
    EXPECT_NEAR(held.reaction(3).force.x(), sign * 2e5, 1);
    EXPECT_LT(held.solution.cases[0].force_residual, 1e-8);
    EXPECT_LT(held.solution.cases[0].moment_residual, 1e-8);
  }
}

TEST(HoldingEquations, NodesOfNothingAreNamed) {
  const Deck deck =
      test::nastran(case_control + two_bars + "GRID,9,,2.,2.,0.\nMPC,3,2,1,1.,9,1,-1.\nENDDATA\n");
  try {
    const Held held(deck);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("deck.bdf:19: an equation has node 9"));
  }
}

}  // namespace
}  // namespace blocklift::structure
