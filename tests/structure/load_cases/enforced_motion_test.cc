// Motions that Nastran's loads enforce (SPCD), against bars in closed form.
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/files/nastran/writer.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

/// A bar along x of 0.001 m2 and 2 m in two pieces, E A = 2e8 N, held at both ends; grid 3 is its
/// middle.
const std::string pulled_bar =
    "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,1.,0.,0.\n"
    "CBAR,1,1,1,3,0.,0.,1.\nCBAR,2,1,3,2,0.,0.,1.\nPBAR,1,1,.001,1.-6,1.-6,1.-6\n"
    "MAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1,2\nSPC1,1,23456,3\n";

std::string subcases(const std::string& loads) {
  std::string text = "SOL 101\nCEND\nSPC = 1\n";
  int number = 0;
  for (const char load : loads)
    text += "SUBCASE " + std::to_string(++number) + "\nLOAD = " + load + "\n";
  return text;
}

void expect_bar(const Deck& deck, const std::vector<std::pair<double, double>>& ends_and_forces) {
  Mesh mesh = deck.mesh;
  mesh.materials[0].yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {2, {}});
  const DeckSolution solution = solve_deck(model, deck, 1);
  ASSERT_EQ(solution.cases.size(), ends_and_forces.size());
  const auto along = [&](const DeckCaseSolution& one, int vertex) {
    return one.motion[6L * model.space().node_of_vertex(vertex)];
  };
  for (std::size_t i = 0; i < ends_and_forces.size(); ++i) {
    SCOPED_TRACE(i);
    const auto [end, force] = ends_and_forces[i];
    const DeckCaseSolution& one = solution.cases[i];
    EXPECT_NEAR(along(one, 0), 0, 1e-12);
    EXPECT_NEAR(along(one, 1), end, 1e-12);
    EXPECT_NEAR(along(one, 2), end / 2 + force / 4e8, 1e-11);
    for (const SupportReaction& reaction : one.reactions) {
      if (reaction.vertex == 1) {
        EXPECT_NEAR(reaction.force.x(), 1e8 * end - force / 2, 0.1);
      }
    }
  }
}

// Alone, beside a force in its set, with its factor in LOAD, added up from two sets, and not in a
// case that does not ask for it.
TEST(EnforcedMotion, MovesWhatConstraintsHold) {
  const Deck deck = test::nastran(
      subcases("95874") + pulled_bar +
      "SPCD,9,2,1,0.001\nSPCD,5,2,1,0.001\nFORCE,5,3,,1000.,1.,0.,0.\nSPCD,6,2,1,0.002\n"
      "FORCE,4,3,,1000.,1.,0.,0.\nLOAD,8,2.,0.5,9,1.5,4\nLOAD,7,1.,1.,9,1.,6\nENDDATA\n");
  const std::vector<std::pair<double, double>> expected{
      {0.001, 0}, {0.001, 1000}, {0.001, 3000}, {0.003, 0}, {0, 1000}};
  expect_bar(deck, expected);
  expect_bar(test::nastran(to_nastran(deck)), expected);
}

// It takes the place of the motion that the constraint has, and stands in the grid's own axes.
TEST(EnforcedMotion, ReplacesTheConstraintsOwn) {
  const Deck deck = test::nastran(
      subcases("93") +
      "BEGIN BULK\nCORD2R,7,0,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nGRID,1,,0.,0.,0.\n"
      "GRID,2,,2.,0.,0.,7\nGRID,3,,1.,0.,0.\nCBAR,1,1,1,3,0.,0.,1.\nCBAR,2,1,3,2,0.,0.,1.\n"
      "PBAR,1,1,.001,1.-6,1.-6,1.-6\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1\nSPC1,1,13456,2\n"
      "SPC,1,2,2,0.005\nSPC1,1,23456,3\nSPCD,9,2,2,-0.001\nFORCE,3,3,,1000.,1.,0.,0.\nENDDATA\n");
  // The grid's y axis is against x.
  expect_bar(deck, {{0.001, 0}, {-0.005, 1000}});
}

// The usual trial of a deck: turned by its one support it follows as a rigid body, and there is no
// force but rounding, which need not be in balance.
TEST(EnforcedMotion, OfARigidBodyExertsNothing) {
  const Deck deck = test::nastran(
      subcases("9") +
      "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\n"
      "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1\nMAT1,1,2.+11,,0.3,7850.\nSPC1,1,123456,1\n"
      "SPCD,9,1,3,0.002,1,5,0.001\nSPCD,9,1,6,0.0007\nENDDATA\n");
  Mesh mesh = deck.mesh;
  mesh.materials[0].yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {1, {}});
  const DeckSolution solution = solve_deck(model, deck, 1);
  ASSERT_EQ(solution.cases.size(), 1U);
  const Vector3 place(2, 1, 0), shift(0, 0, 0.002), turn(0, 0.001, 0.0007);
  const Vector3 moved = solution.cases[0].motion.segment<3>(6L * model.space().node_of_vertex(2));
  EXPECT_LT((moved - shift - turn.cross(place)).norm(), 1e-12);
  EXPECT_LT(solution.cases[0].force_residual, 1e-3);
  EXPECT_LT(solution.cases[0].moment_residual, 1e-3);
}

TEST(EnforcedMotion, OfWhatIsFreeIsRefused) {
  EXPECT_THAT(
      test::complaints_of_nastran(subcases("9") + pulled_bar + "SPCD,9,3,1,0.001\nENDDATA\n"),
      HasSubstr(
          "deck.bdf:16: error: SPCD: the constraints (SPC) of subcase 1 do not hold component "
          "1 of grid 3; a motion is enforced on a freedom that is held"));
}

}  // namespace
}  // namespace blocklift::structure
