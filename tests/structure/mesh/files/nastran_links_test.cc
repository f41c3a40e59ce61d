// Nastran's rigid elements beyond those of one independent grid, general means, masses along
// freedoms, mass spread over cells.
#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/mass_properties.h"
#include "structure/space/links.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;

const std::string grids = R"(GRID,1,,0.,0.,0.
GRID,2,,2000.,0.,0.
GRID,3,,0.,1000.,0.
GRID,4,,300.,400.,500.
CORD2R,7,,0.,0.,0.,0.,.6,.8
,1.,0.,0.
GRID,5,,300.,400.,1500.,7
)";

/// The equation's sum for a motion (displacement, rotation) of each vertex.
double sum_of(const MotionEquation& equation, const std::vector<Vector3>& displacements,
              const std::vector<Vector3>& rotations) {
  double sum = 0;
  for (const MotionEquation::Term& term : equation.terms)
    sum += term.of_displacement.dot(displacements[term.vertex]) +
           term.of_rotation.dot(rotations[term.vertex]);
  return sum;
}

/// A rigid motion fulfils all of a deck's equations, and one that strains them does not.
void expect_rigid(const Deck& deck, std::size_t count) {
  ASSERT_EQ(deck.mesh.equations.size(), count);
  const Vector3 shift(0.3, -0.2, 0.7), turn(0.1, 0.5, -0.4);
  std::vector<Vector3> moved, turned, strained;
  for (const Vector3& place : deck.mesh.vertices) {
    moved.emplace_back(shift + turn.cross(place));
    turned.push_back(turn);
    strained.emplace_back(place.z() * place.x(), place.x() * place.x(), place.y() + place.x());
  }
  for (const MotionEquation& equation : deck.mesh.equations) {
    EXPECT_NEAR(sum_of(equation, moved, turned), 0, 1e-12);
    MotionEquation balanced = equation;
    EXPECT_LT(balance(deck.mesh, balanced), 1e-12);
  }
  EXPECT_GT(std::abs(sum_of(deck.mesh.equations.front(), strained, turned)), 1e-3);
}

// Six components at two ends (three and three turned ones), at three corners, of several grids.
TEST(NastranLinks, RigidElementsOfSeveralIndependentGrids) {
  // Along x both ends are held to each other; the other end turns about the bar with the first.
  expect_rigid(nastran(grids + "RBAR,1,1,2,1234,23\n", "mm-t-N"), 6);
  expect_rigid(nastran(grids + "RTRPLT,1,1,2,3,123,23,3\n", "mm-t-N"), 12);
  expect_rigid(nastran(grids + "RTRPLT,1,1,2,3,123,23,3\n,4\n", "mm-t-N"), 1);
  expect_rigid(nastran(grids + "RBE1,1,1,123,2,23,3,3\n,UM,4,123456\n", "mm-t-N"), 6);
  // Grid 5 has axes of its own.
  expect_rigid(nastran(grids + "RBE1,1,1,123,2,23,3,3\n,UM,5,2\n", "mm-t-N"), 1);
  EXPECT_THAT(complaints_of_nastran(grids + "RBAR,1,1,2,123,123\n"),
              HasSubstr("RBAR: the independent components do not determine a rigid motion"));
  EXPECT_THAT(complaints_of_nastran(grids + "RBE1,1,1,12345,UM,4,123\n"),
              HasSubstr("RBE1: the independent components do not determine a rigid motion"));
}

TEST(NastranLinks, RodsAndJoints) {
  expect_rigid(nastran(grids + "RROD,1,4,2,,1\n", "mm-t-N"), 1);
  EXPECT_EQ(nastran(grids + "RROD,1,4,2,,1\n").mesh.equations[0].terms[0].vertex, 1);
  const Mesh mesh = nastran(grids + "GRID,6,,300.,400.,500.\nRJOINT,1,4,6,12346\n").mesh;
  ASSERT_EQ(mesh.rigid_links.size(), 1U);
  EXPECT_EQ(mesh.rigid_links[0].master, 3);
  EXPECT_FALSE(mesh.rigid_links[0].bound[4]);
}

// With displacements alone the general mean is the distributing link; with rotations it is a second
// least-squares problem, solved by hand for two grids on a line.
// A bush that resists nothing across its line needs no vector there.
TEST(NastranLinks, BushesAlongTheirLine) {
  const std::string deck =
      "GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,2.\nCBUSH,1,5,1,2\nPBUSH,5,K,1000.,,,50.\n";
  const Mesh mesh = nastran(deck).mesh;
  ASSERT_EQ(mesh.springs.size(), 2U);
  for (const Spring& spring : mesh.springs)
    expect_near(spring.axes[0].col(0), Vector3::UnitZ(), 1e-12);
  EXPECT_THAT(complaints_of_nastran(deck + "CBUSH,2,6,1,2\nPBUSH,6,K,1000.,1000.\n"),
              HasSubstr("CBUSH 2 has neither a coordinate system nor a vector"));
}

// Its mass is half at either end; a line without its word, or of another one, is refused.
TEST(NastranLinks, LinesOfBushes) {
  const std::string deck = "GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,2.\nCBUSH,1,5,1,2\n";
  const Mesh mesh = nastran(deck + "PBUSH,5,K,1000.\n,,GE,.02\n,,M,.4\n").mesh;
  ASSERT_EQ(mesh.masses.size(), 2U);
  EXPECT_DOUBLE_EQ(mesh.masses[0].mass, 0.2);
  EXPECT_EQ(mesh.masses[1].vertex, 1);
  EXPECT_THAT(complaints_of_nastran(deck + "PBUSH,5,K,1000.\n,,KMAG,5.\n"),
              HasSubstr("PBUSH 5 has a line of \"KMAG\", which is not known"));
  EXPECT_THAT(complaints_of_nastran(deck + "PBUSH,5,,1000.\n"),
              HasSubstr("PBUSH 5 has \"1000.\" without a word before it"));
  EXPECT_THAT(complaints_of_nastran(deck + "PBUSH,5,K,1000.\nPBUSH,5,K,10.\n"),
              HasSubstr("deck.bdf:5: error: PBUSH: property 5 is there twice"));
  EXPECT_THAT(complaints_of_nastran("GRID,1,,0.,0.,0.\nCELAS1,1,5,1,1\nPELAS,5,100.\n"
                                    "PELAS,6,1.,,,5,2.\n"),
              HasSubstr("deck.bdf:4: error: PELAS: property 5 is there twice"));
}

TEST(NastranLinks, MeansOfAnyComponents) {
  const Deck plain = nastran(grids + "RBE3,1,,4,123456,1.,123,1,2\n,2.,123,3\n", "mm-t-N");
  ASSERT_EQ(plain.mesh.distributing_links.size(), 1U);
  // One whose components differ by nothing that counts: a rotation of next to no weight.
  const Deck general =
      nastran(grids + "RBE3,1,,4,123456,1.,123,1,2\n,2.,123,3,1.-14,4,5\n", "mm-t-N");
  expect_rigid(general, 6);
  Eigen::Matrix3Xd places(3, 5);
  std::vector<int> nodes;
  for (int v = 0; v < 5; ++v) {
    places.col(v) = plain.mesh.vertices[v];
    nodes.push_back(v);
  }
  const auto rows_of = [&](const Deck& deck) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6, 30);
    for (const FreedomTie& tie : find_link_ties(deck.mesh, nodes, places))
      for (std::size_t i = 0; i < tie.masters.size(); ++i)
        rows(tie.freedom - 18, tie.masters[i]) += tie.weights[i];
    return rows;
  };
  EXPECT_LT((rows_of(plain) - rows_of(general)).norm(), 1e-10);

  // Grids 1 and 2 at x = -1 and 1 about the reference; their mean distance is 1 m. Of the least
  // squares of w and theta_y: w = (w1 + w2) / 2, theta_y = (w1 - w2 + t1 + t2) / 4.
  const Deck line = nastran(
      "GRID,1,,-1.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,0.,0.\nRBE3,1,,3,35,1.,123456,1,2\n");
  ASSERT_EQ(line.mesh.equations.size(), 2U);
  const auto coefficients = [&](std::size_t equation, int vertex) -> Eigen::Vector2d {
    for (const MotionEquation::Term& term : line.mesh.equations[equation].terms)
      if (term.vertex == vertex) return {term.of_displacement.z(), term.of_rotation.y()};
    return {0, 0};
  };
  expect_near(coefficients(0, 0), Eigen::Vector2d(-0.5, 0), 1e-14);
  expect_near(coefficients(0, 1), Eigen::Vector2d(-0.5, 0), 1e-14);
  expect_near(coefficients(1, 0), Eigen::Vector2d(-0.25, -0.25), 1e-14);
  expect_near(coefficients(1, 1), Eigen::Vector2d(0.25, -0.25), 1e-14);
  EXPECT_THAT(complaints_of_nastran(grids + "RBE3,1,,4,3,1.,3,1,2\n"),
              HasSubstr("RBE3: the components that count do not determine the motion"));
}

const std::string cube = R"(GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,9,,.5,.3,1.5
CHEXA,1,1,1,2,3,4,5,6
,7,8
PSOLID,1,7
MAT1,7,206.+9,,.3,7850.
)";

// Nothing resists the rotations of solids' grids: they take no share of a load.
TEST(NastranLinks, RotationsThatNothingResistsDoNotCount) {
  const auto turns_of = [](const Deck& deck, int vertex) {
    double sum = 0;
    for (const MotionEquation& equation : deck.mesh.equations)
      for (const MotionEquation::Term& term : equation.terms)
        if (term.vertex == vertex) sum += term.of_rotation.norm();
    return sum;
  };
  const std::string mean = "RBE3,20,,9,123456,1.,123456,5,6\n,7,8\n";
  const Deck deck = nastran(cube + mean);
  ASSERT_EQ(deck.mesh.equations.size(), 6U);
  for (int vertex = 4; vertex < 8; ++vertex) EXPECT_EQ(turns_of(deck, vertex), 0);
  const auto of_rotations = [](const Deck& of) {
    std::vector<DeckRemark> remarks;
    for (const DeckRemark& remark : of.remarks)
      if (remark.text.find("rotations of a grid of solids or rods") != std::string::npos)
        remarks.push_back(remark);
    return remarks;
  };
  const std::vector<DeckRemark> remarks = of_rotations(deck);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_THAT(remarks[0].place, ::testing::EndsWith("deck.bdf:14"));
  EXPECT_EQ(remarks[0].count, 4);
  // A plate over the face resists them.
  const Deck plated = nastran(cube + mean + "CQUAD4,2,2,5,6,7,8\nPSHELL,2,7,.01,7,,7\n");
  EXPECT_GT(turns_of(plated, 4), 0.01);
  EXPECT_TRUE(of_rotations(plated).empty());
  // On a line nothing else tells how the reference turns about it.
  EXPECT_THAT(complaints_of_nastran(cube + "RBE3,20,,9,123456,1.,123456,5,6\n"),
              HasSubstr("deck.bdf:14: error: RBE3: the components that count do not determine"));
}

TEST(NastranLinks, MeansOfGridsWithoutElementsAreRefused) {
  const std::string mean = "GRID,10,,0.,0.,2.\nRBE3,20,,9,123456,1.,123,5,6\n,7,10\n";
  EXPECT_THAT(complaints_of_nastran(cube + mean),
              HasSubstr("deck.bdf:15: error: RBE3: RBE3 20 spreads loads to grid 10, which has no "
                        "element, spring or other link"));
  EXPECT_EQ(complaints_of_nastran(cube + mean + "RBE2,21,5,123,10\n"), "");
  EXPECT_EQ(complaints_of_nastran(cube + mean + "CELAS2,21,1000.,5,1,10,1\n"), "");
}

const std::string plate = R"(GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,5.,0.,0.
CQUAD4,10,5,1,2,3,4
CBAR,11,6,2,5,0.,0.,1.
PSHELL,5,7,.01,7,,7
PBARL,6,7,,ROD
,.1
MAT1,7,206.+9,,.3,7850.
)";

TEST(NastranLinks, MassesAlongFreedoms) {
  const Deck deck = nastran(plate +
                            "CMASS2,20,30.,3,1\nCMASS2,21,30.,3,2\nCMASS1,22,9,3,3\n"
                            "PMASS,8,1.,9,30.\nCMASS2,23,4.,3,5\nCMASS2,24,1.,99,0\nSPOINT,99\n");
  ASSERT_EQ(deck.mesh.masses.size(), 1U);
  EXPECT_DOUBLE_EQ(deck.mesh.masses[0].mass, 30);
  EXPECT_DOUBLE_EQ(deck.mesh.masses[0].inertia(1, 1), 4);
  EXPECT_DOUBLE_EQ(deck.mesh.masses[0].inertia(0, 0), 0);
  EXPECT_THAT(complaints_of_nastran(plate + "CMASS2,20,30.,3,1\n"),
              HasSubstr("are 30, 0 and 0; those of a body are equal"));
  EXPECT_THAT(complaints_of_nastran(plate + "CMASS2,20,30.,3,1,4,1\n"),
              HasSubstr("a mass between two freedoms is no body's"));
}

// 2 m^2 of plate, 3 m of bar.
TEST(NastranLinks, MassSpreadOverCells) {
  const double bare = mass_properties(nastran(plate).mesh).mass;
  const auto extra = [&](const std::string& masses, const std::string& cases = "NSM = 1\n") {
    return mass_properties(nastran("CEND\n" + cases + "BEGIN BULK\n" + plate + masses).mesh).mass -
           bare;
  };
  EXPECT_NEAR(extra("NSM,1,PSHELL,5,10.\n"), 20, 1e-9);
  EXPECT_NEAR(extra("NSM1,1,PBARL,10.,6\n"), 30, 1e-9);
  EXPECT_NEAR(extra("NSM1,1,PBAR,10.,ALL\n"), 30, 1e-9);
  EXPECT_NEAR(extra("NSML1,1,ELEMENT,10.,10,THRU,10\n"), 10, 1e-9);
  EXPECT_NEAR(extra("NSML,1,ELEMENT,11,10.\n"), 10, 1e-9);
  EXPECT_NEAR(extra("NSMADD,1,2,3\nNSM,2,PSHELL,5,10.\nNSM1,3,ELEMENT,1.,11\n"), 23, 1e-9);
  // Nothing asks for it.
  EXPECT_NEAR(extra("NSM,1,PSHELL,5,10.\n", ""), 0, 1e-9);
  EXPECT_THAT(complaints_of_nastran("CEND\nNSM = 4\nBEGIN BULK\n" + plate),
              HasSubstr("deck.bdf:2: error: case control: set 4 of spread masses (NSM) does not "
                        "exist"));
  EXPECT_THAT(
      complaints_of_nastran("CEND\nNSM = 1\nBEGIN BULK\n" + plate + "NSM1,1,PSHELL,10.,6\n"),
      HasSubstr("NSM1: there is no cell of PSHELL that has mass spread over it"));
}

// A combination is listed; its title is not that of the subcase before it.
TEST(NastranLinks, CombinationsOfSubcasesAreListed) {
  const Deck deck = nastran(
      "CEND\nSUBCASE 1\nSUBTITLE = first\nSUBCOM 2\nSUBTITLE = both\n"
      "SUBSEQ = 1., 1.\nSUBCASE 3\nSUBTITLE = third\nBEGIN BULK\n" +
      plate);
  ASSERT_EQ(deck.load_cases.size(), 2U);
  EXPECT_EQ(deck.load_cases[0].title, "first");
  EXPECT_EQ(deck.load_cases[1].title, "third");
}

}  // namespace
}  // namespace blocklift::structure::test
