// What *DLOAD and *DSLOAD put on plates, solids and bars: resultants by hand, and a strip.
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/load_cases/deck_loads.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/system/matter.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure {
namespace {

using ::testing::HasSubstr;

/// A cube of 1 m, a plate of 1 x 1 x 0.01 m beside its top with its normal upwards, and a bar of
/// 1 m x 0.1 x 0.05 m behind that, whose axis n1 is z.
std::string deck_under(const std::string& loads) {
  return "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
         "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n9, 2., 0., 1.\n10, 2., 1., 1.\n"
         "11, 3., 1., 1.\n"
         "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "*ELEMENT, TYPE=S4, ELSET=PLATE\n2, 6, 9, 10, 7\n"
         "*ELEMENT, TYPE=B31, ELSET=BAR\n3, 10, 11\n"
         "*SURFACE, NAME=UPPER\nPLATE, SPOS\n*SURFACE, NAME=RIM\nPLATE, E2\n"
         "*SURFACE, NAME=FRONT\nCUBE, S3\n"
         "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, 0.3\n*DENSITY\n7850.\n"
         "*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n"
         "*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n0.01\n"
         "*BEAM SECTION, ELSET=BAR, MATERIAL=M, SECTION=RECT\n0.1, 0.05\n0., 0., 1.\n"
         "*NSET, NSET=FOOT\n1, 2, 3, 4\n*BOUNDARY\nFOOT, 1, 3\n6, 1, 6\n7, 1, 6\n"
         "*STEP\n*STATIC\n" +
         loads + "*END STEP\n";
}

Wrench sum_under(const Deck& deck, int degree) {
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {degree, {}});
  return resultant(model.space(), load_of(model, deck, deck.load_cases.at(0)));
}

/// @param place through which the force goes.
void expect_force(const std::string& loads, const Vector3& force, const Vector3& place) {
  for (const int degree : {1, 3}) {
    const Wrench sum = sum_under(test::abaqus(deck_under(loads)), degree);
    EXPECT_LT((sum.force - force).norm(), 1e-9 * force.norm()) << loads;
    EXPECT_LT((sum.moment - place.cross(force)).norm(), 1e-9 * force.norm()) << loads;
  }
}

std::string complaints_under(const std::string& loads) {
  return test::complaints_of_abaqus(deck_under(loads));
}

const Vector3 of_cube(.5, .5, .5), of_front(.5, 0, .5), of_plate(1.5, .5, 1), of_bar(2.5, 1, 1),
    of_rim(2, .5, 1);

TEST(AbaqusLoads, PerVolume) {
  expect_force("*DLOAD\nCUBE, BX, 100.\n", Vector3(100, 0, 0), of_cube);
  expect_force("*DLOAD\nPLATE, BZ, -100.\n", Vector3(0, 0, -1), of_plate);
  expect_force("*DLOAD\nBAR, BY, 100.\n", Vector3(0, .5, 0), of_bar);
}

// Against the height below the level: 5 N on the face, a third of the depth above its foot.
TEST(AbaqusLoads, Hydrostatic) {
  expect_force("*DLOAD\nCUBE, HP3, 10., 1., 0.\n", Vector3(0, 5, 0), Vector3(.5, 0, 1. / 3));
  expect_force("*DSLOAD\nFRONT, HP, 10., 1., 0.\n", Vector3(0, 5, 0), Vector3(.5, 0, 1. / 3));
  expect_force("*DLOAD\nPLATE, HP, 10., 3., 0.\n", Vector3(0, 0, 20. / 3), of_plate);
  expect_force("*DSLOAD\nUPPER, HP, 10., 3., 0.\n", Vector3(0, 0, -20. / 3), of_plate);
  EXPECT_THAT(complaints_under("*DLOAD\nPLATE, HP, 10., .5, 0.\n"),
              HasSubstr("element 2 reaches beyond the level at which HP is zero"));
  EXPECT_THAT(complaints_under("*DLOAD\nPLATE, HP, 10., 3., 3.\n"), HasSubstr("at the same level"));
}

TEST(AbaqusLoads, Tractions) {
  expect_force("*DLOAD\nPLATE, TRVEC, 10., 0., 3., 4.\n", Vector3(0, 6, 8), of_plate);
  expect_force("*DSLOAD\nUPPER, TRVEC, 10., 0., 3., 4.\n", Vector3(0, 6, 8), of_plate);
  expect_force("*DLOAD\nCUBE, TRVEC3, 10., 0., 3., 4.\n", Vector3(0, 6, 8), of_front);
  expect_force("*DLOAD\nPLATE, TRSHR, 10., 0., 3., 4.\n", Vector3(0, 10, 0), of_plate);
  expect_force("*DSLOAD\nFRONT, TRSHR, 10., 0., 3., 4.\n", Vector3(0, 0, 10), of_front);
  EXPECT_THAT(complaints_under("*DLOAD\nPLATE, TRVEC, 10.\n"), HasSubstr("TRVEC has no direction"));
  EXPECT_THAT(complaints_under("*DLOAD\nPLATE, TRSHR, 10., 0., 0., 1.\n"),
              HasSubstr("TRSHR has no direction along the face of element 2"));
}

// E2 of the plate is its far edge, along y.
TEST(AbaqusLoads, EdgesOfShells) {
  for (const auto& [kind, force] :
       {std::pair{"EDNOR", Vector3(-10, 0, 0)}, std::pair{"EDSHR", Vector3(0, 10, 0)},
        std::pair{"EDTRA", Vector3(0, 0, -10)}}) {
    expect_force(fmt::format("*DLOAD\nPLATE, {}2, 10.\n", kind), force, of_rim);
    expect_force(fmt::format("*DSLOAD\nRIM, {}, 10.\n", kind), force, of_rim);
  }
  expect_force("*DLOAD\nPLATE, EDLD2, 10., 0., 3., 4.\n", Vector3(0, 6, 8), of_rim);
  EXPECT_THAT(complaints_under("*DLOAD\nPLATE, EDNOR5, 10.\n"),
              HasSubstr("edge 5 of element 2 is not known; 1 to 4 are"));
  EXPECT_THAT(complaints_under("*DSLOAD\nRIM, P, 10.\n"),
              HasSubstr("a load P on face E2 of element 2 is not known"));
  EXPECT_THAT(complaints_under("*DSLOAD\nRIM, EDMOM, 10.\n"),
              HasSubstr("a load EDMOM is not known; P, HP, TRVEC and TRSHR on faces, EDNOR"));
}

// All triangles' edges, and curved ones: what pushes inwards at right angles to a plane line is, in
// sum, its chord turned, whatever the line between its ends.
TEST(AbaqusLoads, EdgesOfTrianglesAndCurvedShells) {
  const std::string rest =
      "*SHELL SECTION, ELSET=A, MATERIAL=M\n.01\n*MATERIAL, NAME=M\n*ELASTIC\n2.e11, .3\n"
      "*DENSITY\n7850.\n*BOUNDARY\n1, 1, 6\n2, 1, 6\n*STEP\n*STATIC\n*DLOAD\n";
  const std::string triangle =
      "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 0., 1., 0.\n*ELEMENT, TYPE=S3, ELSET=A\n1, 1, 2, "
      "3\n" +
      rest;
  const auto sum = [&](const std::string& text) {
    return sum_under(test::abaqus(text + "*END STEP\n"), 2).force;
  };
  EXPECT_LT((sum(triangle + "1, EDNOR1, 10.\n") - Vector3(0, 20, 0)).norm(), 1e-9);
  EXPECT_LT((sum(triangle + "1, EDNOR2, 10.\n") - Vector3(-10, -20, 0)).norm(), 1e-9);
  EXPECT_LT((sum(triangle + "1, EDNOR3, 10.\n") - Vector3(10, 0, 0)).norm(), 1e-9);
  EXPECT_LT((sum(triangle + "1, EDSHR3, 10.\n") - Vector3(0, -10, 0)).norm(), 1e-9);
  const std::string curved =
      "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 2., 0.\n4, 0., 2., 0.\n5, 1., 0., 0.\n"
      "6, 2.4, 1., 0.\n7, 1., 2., 0.\n8, 0., 1., 0.\n*ELEMENT, TYPE=S8R, ELSET=A\n"
      "1, 1, 2, 3, 4, 5, 6, 7, 8\n" +
      rest;
  EXPECT_LT((sum(curved + "1, EDNOR2, 10.\n") - Vector3(-20, 0, 0)).norm(), 1e-6);
  EXPECT_LT((sum(curved + "1, EDSHR2, 10.\n") - Vector3(0, 20, 0)).norm(), 1e-6);
}

// n2 is the bar's direction times n1.
TEST(AbaqusLoads, AlongBars) {
  expect_force("*DLOAD\nBAR, P1, 100.\n", Vector3(0, 0, 100), of_bar);
  expect_force("*DLOAD\nBAR, P2, 100.\n", Vector3(0, -100, 0), of_bar);
  expect_force("*DLOAD\nBAR, PY, 100.\n", Vector3(0, 100, 0), of_bar);
}

TEST(AbaqusLoads, WhatIsNotKnownIsLeftOutAndSaid) {
  const Deck deck = test::abaqus(deck_under("*DLOAD\nPLATE, VP, 10.\nBAR, P, 10.\n"));
  EXPECT_TRUE(deck.load_cases.at(0).loads.empty());
  ASSERT_EQ(deck.remarks.size(), 2U);
  EXPECT_THAT(deck.remarks[0].text,
              HasSubstr("a load VP is left out: loads other than P, HP, TRVEC, TRSHR, BX, BY, BZ"));
  EXPECT_THAT(deck.remarks[1].text, HasSubstr("a load P is left out"));
}

// Another load of the same kind in a later step takes the place of the first; another kind does
// not.
TEST(AbaqusLoads, LaterStepsReplaceWhatIsOfTheirKind) {
  const Deck deck = test::abaqus(
      deck_under("*DLOAD\nPLATE, EDNOR2, 10.\nCUBE, BX, 5.\n*END STEP\n*STEP\n*STATIC\n*DLOAD\n"
                 "PLATE, EDNOR2, 20.\nPLATE, EDNOR1, 3.\n"));
  ASSERT_EQ(deck.load_sets.size(), 2U);
  EXPECT_EQ(deck.load_sets[1].edge_loads.size(), 2U);
  EXPECT_EQ(deck.load_sets[1].volume_loads.size(), 1U);
  double most = 0;
  for (const EdgeLoad& load : deck.load_sets[1].edge_loads) most = std::max(most, load.own[1]);
  EXPECT_DOUBLE_EQ(most, 20);
}

// A strip of 1 x 0.2 m, 10 mm thick, without Poisson's effect: F l^3 / (3 E I) at its free edge.
TEST(AbaqusLoads, AStripBendsUnderTheLoadOfItsEdge) {
  const Deck deck = test::abaqus(
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., .2, 0.\n4, 0., .2, 0.\n"
      "*ELEMENT, TYPE=S4, ELSET=A\n1, 1, 2, 3, 4\n*SHELL SECTION, ELSET=A, MATERIAL=M\n.01\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n2.e11, 0.\n*DENSITY\n7850.\n*BOUNDARY\n1, 1, 6\n4, 1, 6\n"
      "*STEP\n*STATIC\n*DLOAD\nA, EDTRA2, -10.\n*END STEP\n");
  Mesh mesh = deck.mesh;
  for (Material& material : mesh.materials) material.yield_stress = 235e6;
  const ElasticModel model(std::move(mesh), {3, {}});
  const DeckCaseSolution solution = solve_deck(model, deck, 1).cases.at(0);
  const double due = 10 * .2 / (3 * 2e11 * .2 * 1e-6 / 12);
  EXPECT_NEAR(solution.motion[6L * model.space().node_of_vertex(1) + 2], due, 1e-3 * due);
}

}  // namespace
}  // namespace blocklift::structure
