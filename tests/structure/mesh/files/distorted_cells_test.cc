// Cells of decks that are numbered inside out, or folded.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/shell_shape.h"
#include "structure/mesh/solid_shape.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Corners of a cube of 1 m, 1 to 8; 9 above its middle.
const std::string grids_of_cube =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
    "GRID,9,,.5,.5,2.\n";
const std::string property_of_solids = "PSOLID,5,7\nMAT1,7,206.+9,,.3,7850.\n";
const std::string property_of_plates = "PSHELL,5,7,.01,7,,7\nMAT1,7,206.+9,,.3,7850.\n";

const std::string nodes_of_cube =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
    "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n";
const std::string steel_solids =
    "*SOLID SECTION, ELSET=E, MATERIAL=Steel\n"
    "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n";

std::string remarks_of(const Deck& deck) {
  std::string text;
  for (const DeckRemark& remark : deck.remarks) text += remark.place + ": " + remark.text + "\n";
  return text;
}

// Their volumes: 1, 1/2, 1/6 and 1/3 m^3.
TEST(DistortedCells, SolidsThatAreNumberedInsideOutAreTurned) {
  const Deck deck = nastran(grids_of_cube +
                            "CHEXA,101,5,5,6,7,8,1,2\n,3,4\nCPENTA,102,5,5,6,7,1,2,3\n"
                            "CTETRA,103,5,1,3,2,5\nCPYRAM,104,5,5,8,7,6,9\n" +
                            property_of_solids);
  ASSERT_EQ(deck.mesh.solids.size(), 4U);
  for (const Solid& solid : deck.mesh.solids)
    EXPECT_GT(least_jacobian_ratio(deck.mesh, solid), 0) << solid.label;
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 7850 * (1 + 1 / 2.0 + 1 / 6.0 + 1 / 3.0), 1e-6);
  EXPECT_THAT(remarks_of(deck),
              HasSubstr("deck.bdf:10: 4 solids are numbered inside out, element 101 the first"));
  const Deck sound =
      nastran(grids_of_cube + "CHEXA,101,5,1,2,3,4,5,6\n,7,8\n" + property_of_solids);
  EXPECT_THAT(remarks_of(sound), Not(HasSubstr("inside out")));
}

// A pressure on a face by its number acts on the nodes that have this number in the deck: S1 is
// the first four, here the upper ones.
TEST(DistortedCells, FacesOfTurnedSolidsKeepTheirNumbers) {
  const Deck deck =
      abaqus(nodes_of_cube + "*ELEMENT, TYPE=C3D8, ELSET=E\n10, 5, 6, 7, 8, 1, 2, 3, 4\n" +
             steel_solids + "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*DLOAD\nE, P1, 2.e6\n*END STEP\n");
  EXPECT_THAT(remarks_of(deck), HasSubstr("1 solid is numbered inside out, element 10 the first"));
  ASSERT_EQ(deck.load_sets.size(), 1U);
  ASSERT_EQ(deck.load_sets[0].solid_loads.size(), 1U);
  const SolidLoad& load = deck.load_sets[0].solid_loads[0];
  const Solid& solid = deck.mesh.solids[0];
  for (const int corner : topology_of(solid.shape).faces[load.face])
    EXPECT_EQ(deck.mesh.vertices[solid.vertices[corner]].z(), 1);
}

// Two corners of its upper face have changed places: the volume is positive, but not everywhere.
TEST(DistortedCells, FoldedSolidsAreRefusedAtTheirLine) {
  EXPECT_THAT(
      complaints_of_nastran(grids_of_cube + "CHEXA,101,5,1,2,3,4,6,5\n,7,8\n" + property_of_solids),
      HasSubstr("deck.bdf:10: error: CHEXA: element 101 is folded or has no volume"));
  EXPECT_THAT(complaints_of_abaqus(nodes_of_cube +
                                   "*ELEMENT, TYPE=C3D8, ELSET=E\n10, 1, 2, 3, 4, 6, 5, 7, 8\n" +
                                   steel_solids),
              HasSubstr("deck.inp:11: error: *ELEMENT: element 10 is folded or has no volume"));
}

// The upper face is turned by a quarter: its Jacobian is 1/2 and more of the cube's everywhere. An
// eighth, or a leaning corner, is a shape that a deck may have.
TEST(DistortedCells, TwistedSolidsAreRefusedAtTheirLine) {
  EXPECT_THAT(
      complaints_of_nastran(grids_of_cube + "CHEXA,101,5,1,2,3,4,6,7\n,8,5\n" + property_of_solids),
      HasSubstr("deck.bdf:10: error: CHEXA: element 101 is twisted: two opposite faces are turned "
                "against each other"));
  EXPECT_THAT(complaints_of_abaqus(nodes_of_cube +
                                   "*ELEMENT, TYPE=C3D8, ELSET=E\n10, 1, 2, 3, 4, 8, 5, 6, 7\n" +
                                   steel_solids),
              HasSubstr("deck.inp:11: error: *ELEMENT: element 10 is twisted"));
  EXPECT_THAT(
      complaints_of_nastran(grids_of_cube + "CPENTA,101,5,1,2,3,6,7,5\n" + property_of_solids),
      HasSubstr("element 101 is twisted"));
  const std::string eighth =
      "GRID,15,,.5,-.2071068,1.\nGRID,16,,1.2071068,.5,1.\nGRID,17,,.5,1.2071068,1.\n"
      "GRID,18,,-.2071068,.5,1.\nCHEXA,101,5,1,2,3,4,15,16\n,17,18\n";
  EXPECT_EQ(complaints_of_nastran(grids_of_cube + eighth + property_of_solids), "");
  // A quarter of a ring in one piece.
  EXPECT_EQ(complaints_of_nastran(grids_of_cube +
                                  "GRID,15,,2.,0.,0.\nGRID,16,,0.,2.,0.\n"
                                  "GRID,17,,2.,0.,1.\nGRID,18,,0.,2.,1.\n"
                                  "CHEXA,101,5,2,15,16,4,6,17\n,18,8\n" +
                                  property_of_solids),
            "");
  EXPECT_EQ(complaints_of_nastran(grids_of_cube + "GRID,17,,1.3,1.3,1.3\n" +
                                  "CHEXA,101,5,1,2,3,4,5,6\n,17,8\n" + property_of_solids),
            "");
}

// Volumes of a half, a third and a sixth of the cube; a pressure on a triangle that was a face of
// four corners acts on what is left of it.
TEST(DistortedCells, SolidsWhoseCornersFallTogetherAreWhatIsLeftOfThem) {
  const auto shape_and_volume = [](const std::string& card, SolidShape shape, double volume) {
    const Deck deck = nastran(grids_of_cube + card + property_of_solids);
    ASSERT_EQ(deck.mesh.solids.size(), 1U);
    EXPECT_EQ(deck.mesh.solids[0].shape, shape) << card;
    EXPECT_NEAR(mass_properties(deck.mesh).mass, 7850 * volume, 1e-6) << card;
    EXPECT_THAT(remarks_of(deck), AllOf(HasSubstr("with one grid at several corners is read as"),
                                        Not(HasSubstr("inside out"))));
  };
  shape_and_volume("CHEXA,101,5,1,2,3,3,5,6\n,7,7\n", SolidShape::wedge, .5);
  shape_and_volume("CHEXA,101,5,1,1,3,4,5,5\n,7,8\n", SolidShape::wedge, .5);
  shape_and_volume("CHEXA,101,5,1,2,3,4,5,6\n,3,4\n", SolidShape::wedge, .5);
  shape_and_volume("CHEXA,101,5,1,2,3,4,5,5\n,5,5\n", SolidShape::pyramid, 1 / 3.);
  shape_and_volume("CHEXA,101,5,1,2,3,3,5,5\n,5,5\n", SolidShape::tetrahedron, 1 / 6.);
  shape_and_volume("CPENTA,101,5,1,2,3,5,5,5\n", SolidShape::tetrahedron, 1 / 6.);
  shape_and_volume("CPENTA,101,5,1,2,3,5,6,3\n", SolidShape::pyramid, 1 / 3.);
  shape_and_volume("CPYRAM,101,5,1,2,3,3,5\n", SolidShape::tetrahedron, 1 / 6.);
  EXPECT_THAT(
      complaints_of_nastran(grids_of_cube + "CHEXA,101,5,1,2,3,4,5,6\n,7,7\n" + property_of_solids),
      HasSubstr(
          "deck.bdf:10: error: CHEXA: element 101 has grid 7 twice, and what is left of it is "
          "no wedge, pyramid or tetrahedron"));
  const std::string of_abaqus = nodes_of_cube + "*ELEMENT, TYPE=C3D8, ELSET=E\n";
  const Deck deck = abaqus(of_abaqus + "10, 1, 2, 3, 3, 5, 6, 7, 7\n" + steel_solids +
                           "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*DLOAD\nE, P2, 2.e6\nE, P3, 2.e6\n"
                           "*END STEP\n");
  EXPECT_EQ(deck.mesh.solids.at(0).shape, SolidShape::wedge);
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 7850 * .5, 1e-6);
  ASSERT_EQ(deck.load_sets.at(0).solid_loads.size(), 2U);
  const SolidLoad& load = deck.load_sets[0].solid_loads[0];
  const Solid& wedge = deck.mesh.solids[0];
  const std::vector<int>& face = topology_of(wedge.shape).faces[load.face];
  EXPECT_EQ(face.size(), 3U);
  for (const int corner : face) EXPECT_EQ(deck.mesh.vertices[wedge.vertices[corner]].z(), 1);
  EXPECT_THAT(complaints_of_abaqus(of_abaqus + "10, 1, 2, 3, 3, 5, 6, 7, 7\n" + steel_solids +
                                   "*STEP\n*STATIC\n*DLOAD\nE, P5, 2.e6\n*END STEP\n"),
              HasSubstr("face S5 of element 10 is an edge or a point"));
  EXPECT_THAT(complaints_of_abaqus(of_abaqus + "10, 1, 2, 3, 4, 5, 6, 7, 7\n" + steel_solids),
              HasSubstr("element 10 has one node twice, and what is left of it is no wedge"));
}

// A quadratic wedge keeps the middles of its edges, where they are one for each.
TEST(DistortedCells, CollapsedSolidsKeepTheMiddlesOfTheirEdges) {
  const auto card = [](const char* of_edge_4) {
    return grids_of_cube + "GRID,10,,.5,0.,.05\nGRID,12,,.5,.5,0.\nGRID,13,,.5,.6,0.\n" +
           "CHEXA,101,5,1,2,3,3,5,6\n,7,7,10,,," + of_edge_4 + "\n" + property_of_solids;
  };
  const Deck deck = nastran(card("12"));
  const Solid& wedge = deck.mesh.solids.at(0);
  EXPECT_EQ(wedge.shape, SolidShape::wedge);
  int found = 0;
  for (const int vertex : wedge.vertices)
    found += static_cast<int>((deck.mesh.vertices[vertex] - Vector3(.5, 0, .05)).norm() < 1e-12);
  EXPECT_EQ(found, 1);
}

TEST(DistortedCells, QuadranglesWithANodeTwiceAreTriangles) {
  for (const char* corners : {"1, 2, 3, 3", "1, 1, 2, 3", "1, 2, 2, 3", "1, 2, 3, 1"}) {
    const Deck deck = abaqus(nodes_of_cube + "*ELEMENT, TYPE=S4, ELSET=P\n7, " + corners +
                             "\n*SHELL SECTION, ELSET=P, MATERIAL=Steel\n.01\n"
                             "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n");
    ASSERT_EQ(deck.mesh.shells.size(), 1U);
    EXPECT_TRUE(deck.mesh.shells[0].is_triangle()) << corners;
    EXPECT_NEAR(mass_properties(deck.mesh).mass, 7850 * .01 * .5, 1e-9) << corners;
    EXPECT_THAT(remarks_of(deck),
                HasSubstr("a quadrangle with one node twice is read as a triangle"));
  }
  EXPECT_THAT(
      complaints_of_abaqus(nodes_of_cube +
                           "*ELEMENT, TYPE=S4, ELSET=P\n7, 1, 2, 2, 2\n"
                           "*SHELL SECTION, ELSET=P, MATERIAL=Steel\n.01\n"
                           "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n"),
      HasSubstr("deck.inp:11: error: *ELEMENT: element 7 has corners in one node and no area"));
}

// Along the edge from 1 to 2 the place is a parabola through its middle, which turns back within
// the edge where the middle lies beyond 3/4 of it.
TEST(DistortedCells, MiddlesThatLieFarOffFoldASolid) {
  const auto deck = [](const char* x) {
    return grids_of_cube + "GRID,10,," + x + ",0.,0.\nCTETRA,103,5,1,2,3,5,10\n" +
           property_of_solids;
  };
  EXPECT_EQ(complaints_of_nastran(deck(".7")), "");
  EXPECT_THAT(complaints_of_nastran(deck(".8")),
              AllOf(HasSubstr("element 103 is folded"),
                    HasSubstr("edge at (0.8, 0, 0) m is 0.2 of the edge from a corner")));
}

TEST(DistortedCells, MiddlesBeyondAnEndFoldABeam) {
  const auto deck = [](const char* nodes) {
    return nodes_of_cube + "*ELEMENT, TYPE=B32, ELSET=B\n7, " + nodes +
           "\n*BEAM SECTION, ELSET=B, SECTION=RECT, MATERIAL=Steel\n.1, .02\n0., 0., 1.\n"
           "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n";
  };
  // Around a corner of the cube, then by way of the opposite one.
  EXPECT_EQ(complaints_of_abaqus(deck("1, 2, 3")), "");
  EXPECT_THAT(complaints_of_abaqus(deck("1, 7, 2")), HasSubstr("element 7 is folded"));
}

TEST(DistortedCells, ManyFoldedSolidsAreCounted) {
  std::string deck = grids_of_cube;
  for (int e = 101; e < 125; ++e) deck += "CTETRA," + std::to_string(e) + ",5,1,2,3,4\n";  // flat
  EXPECT_THAT(complaints_of_nastran(deck + property_of_solids),
              AllOf(HasSubstr("element 110 is folded"), Not(HasSubstr("element 111 is folded")),
                    HasSubstr("CTETRA: one more element is folded or twisted (14 times)")));
}

// 1 2 4 3 in place of 1 2 3 4 is a bow tie, whose halves cancel each other.
TEST(DistortedCells, FoldedPlatesAreRefusedAtTheirLine) {
  const auto quadrangle = [](const char* corners) {
    return grids_of_cube + "GRID,10,,.1,.1,0.\nGRID,11,,.5,.5,0.\nCQUAD4,7,5," + corners + "\n" +
           property_of_plates;
  };
  EXPECT_THAT(complaints_of_nastran(quadrangle("1,2,4,3")),
              HasSubstr("deck.bdf:12: error: CQUAD4: element 7 is folded"));
  // One whose halves are unequal, and one that turns inwards.
  EXPECT_THAT(complaints_of_nastran(quadrangle("10,2,4,3")), HasSubstr("element 7 is folded"));
  EXPECT_EQ(complaints_of_nastran(quadrangle("10,2,3,4")), "");
  EXPECT_THAT(complaints_of_nastran(quadrangle("1,2,10,4")), HasSubstr("element 7 is folded"));
  // Three corners in line, and a warped one, are no such thing.
  EXPECT_EQ(complaints_of_nastran(quadrangle("1,2,11,4")), "");
  EXPECT_EQ(complaints_of_nastran(quadrangle("1,2,7,4")), "");
  EXPECT_THAT(complaints_of_abaqus(
                  nodes_of_cube + "*ELEMENT, TYPE=S4, ELSET=P\n7, 1, 2, 4, 3\n"
                                  "*SHELL SECTION, ELSET=P, MATERIAL=Steel\n.01\n"
                                  "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n"),
              HasSubstr("deck.inp:11: error: *ELEMENT: element 7 is folded"));
}

TEST(DistortedCells, MiddlesThatLieFarOffFoldAPlate) {
  const auto deck = [](const char* x) {
    return grids_of_cube + "GRID,10,," + x + ",0.,0.\nCQUAD8,7,5,1,2,3,4,10\n" + property_of_plates;
  };
  EXPECT_EQ(complaints_of_nastran(deck(".7")), "");
  EXPECT_THAT(complaints_of_nastran(deck(".8")), HasSubstr("or middles of its edges lie far off"));
  const auto triangle = [](const char* x) {
    return grids_of_cube + "GRID,10,," + x + ",0.,0.\nCTRIA6,7,5,1,2,3,10\n" + property_of_plates;
  };
  EXPECT_EQ(complaints_of_nastran(triangle(".7")), "");
  EXPECT_THAT(complaints_of_nastran(triangle(".8")), HasSubstr("element 7 is folded"));
}

// Elements of degree 1 leave out how high the middle of an edge stands: what is fastened there
// hangs beside them. A straight edge's middle, and one that nothing is fastened to, are on them.
TEST(DistortedCells, FastenedMiddlesOfCurvedEdgesLieOffStraightShells) {
  const std::string deck = grids_of_cube +
                           "GRID,10,,.5,0.,.1\nGRID,11,,1.,.5,0.\nCQUAD8,7,5,1,2,3,4,10,11\n" +
                           property_of_plates;
  EXPECT_TRUE(fastened_off_straight_shells(nastran(deck).mesh).empty());
  EXPECT_TRUE(fastened_off_straight_shells(nastran(deck + "CONM2,9,11,,5.\n").mesh).empty());
  const std::vector<int> off =
      fastened_off_straight_shells(nastran(deck + "CONM2,9,10,,5.\n").mesh);
  EXPECT_THAT(off, ::testing::ElementsAre(9));
}

}  // namespace
}  // namespace blocklift::structure::test
