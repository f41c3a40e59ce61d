// Solids of Nastran's and Abaqus' decks.
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/error.h"
#include "structure/mesh/diagnosis/diagnosis.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/files/abaqus/writer.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/mass_properties.h"
#include "structure/mesh/solid_shape.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;

/// A cube of 1 m, a wedge of half of one on it, and a tetrahedron beside it.
const std::string nastran_solids = R"(GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,9,,0.,0.,2.
GRID,10,,1.,0.,2.
GRID,11,,1.,1.,2.
GRID,12,,2.,0.,0.
CHEXA,101,5,1,2,3,4,5,6
,7,8
CPENTA,102,5,5,6,7,9,10,11
CTETRA,103,6,2,12,3,6
PSOLID,5,7
PSOLID,6,7
MAT1,7,206.+9,,.3,7850.
)";

const std::string abaqus_solids = R"(*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
9, .5, .5, 3.
*ELEMENT, TYPE=C3D8R, ELSET=CUBE
10, 1, 2, 3, 4, 5, 6, 7, 8
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
*SURFACE, NAME=TOP
CUBE, S2
*COUPLING, REF NODE=9, SURFACE=TOP, CONSTRAINT NAME=C
*DISTRIBUTING
*MATERIAL, NAME=STEEL
*ELASTIC
206.E9, .3
*DENSITY
7850.
)";

/// With a pyramid on the side of the cube.
const std::string abaqus_solids_with_pyramid = [] {
  std::string deck = abaqus_solids;
  deck.insert(deck.find("*ELEMENT"), "20, 2., .5, .5\n");
  deck.insert(deck.find("*SOLID"), "*ELEMENT, TYPE=C3D5, ELSET=CUBE\n11, 2, 3, 7, 6, 20\n");
  deck.replace(deck.find("CUBE, S2"), 8, "11, S3");
  return deck;
}();

const std::string nastran_wood = "MAT11,7,12.+9,.9+9,.5+9,.4,.45,.35,.8+9\n,.7+9,.05+9,500.\n";

/// The same, in axes of its own.
Elasticity wood() {
  return orthotropic_elasticity({{12e9, 0.9e9, 0.5e9}, {0.4, 0.45, 0.35}, {0.8e9, 0.7e9, 0.05e9}});
}

Eigen::Matrix3d turn_about_z(double degrees) {
  return Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180, Vector3::UnitZ()).toRotationMatrix();
}

const Elasticity& elasticity_in(const Deck& deck, std::size_t solid) {
  return deck.mesh.elasticities.at(deck.mesh.solids.at(solid).elasticity);
}

// A pyramid of a third of a cube beside the cube, on its face x = 1.
TEST(SolidDecks, PyramidsStandOnHexahedra) {
  const std::string grids = nastran_solids.substr(0, nastran_solids.find("GRID,9"));
  const std::string tip = "GRID,20,,2.,.5,.5\n";
  const Deck deck = nastran(grids + tip +
                            "CHEXA,101,5,1,2,3,4,5,6\n,7,8\nCPYRAM,102,5,2,3,7,6,20\n"
                            "PSOLID,5,7\nMAT1,7,206.+9,,.3,7850.\n");
  ASSERT_EQ(deck.mesh.solids.size(), 2U);
  EXPECT_EQ(deck.mesh.solids[1].shape, SolidShape::pyramid);
  EXPECT_EQ(deck.mesh.solids[1].vertices.size(), 13U);
  EXPECT_EQ(deck.mesh.vertices.size(), 8U + 1 + 12 + 8 - 4);  // the base's middles are the cube's
  EXPECT_EQ(outer_faces(deck.mesh).size(), 5U + 4);
  const MeshMass mass = mass_properties(deck.mesh);
  EXPECT_NEAR(mass.mass, 7850 * (1 + 1 / 3.0), 1e-8 * 7850);
  // The centre of a pyramid lies a quarter of its height from the base.
  EXPECT_NEAR(mass.centre.x(), (0.5 + 1.25 / 3) / (1 + 1 / 3.0), 1e-10);
  EXPECT_EQ(diagnose(deck.mesh, {}).parts, 1);
  const DeckFolder folder;
  write_nastran(deck, folder.path() / "again.bdf");
  const Deck again = read_nastran(folder.path() / "again.bdf", deck.units);
  EXPECT_LT(
      (places_of(again.mesh, again.mesh.solids[1]) - places_of(deck.mesh, deck.mesh.solids[1]))
          .norm(),
      1e-10);
  EXPECT_THROW(write_abaqus(deck, folder.path() / "again.inp"), ModelError);
  const std::string abaqus_deck = abaqus_solids_with_pyramid;
  const Deck other = abaqus(abaqus_deck);
  EXPECT_EQ(other.mesh.solids.at(1).shape, SolidShape::pyramid);
  EXPECT_NEAR(mass_properties(other.mesh).mass, mass.mass, 1e-8 * 7850);
  // S3 of a C3D5 is that of its second, fifth and third node.
  ASSERT_EQ(other.mesh.distributing_links.size(), 1U);
  EXPECT_EQ(other.mesh.distributing_links[0].vertices.size(), 3U);
}

// Axis 1 stands 30 degrees from x; the same by constants, by the matrix, and by Abaqus' words.
TEST(SolidDecks, DirectionalMaterialsHaveAxesOfTheirOwn) {
  const std::string cube =
      nastran_solids.substr(0, nastran_solids.find("GRID,9")) + "CHEXA,101,5,1,2,3,4,5,6\n,7,8\n";
  const std::string system = "CORD2R,3,,0.,0.,0.,0.,0.,1.\n,.8660254037844387,.5,0.\n";
  const Deck deck = nastran(cube + system + "PSOLID,5,7,3\n" + nastran_wood);
  const Elasticity expected = turned(wood(), turn_about_z(30));
  EXPECT_LT((elasticity_in(deck, 0) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 500, 1e-6);
  ASSERT_FALSE(deck.remarks.empty());
  EXPECT_THAT(deck.remarks.back().text, HasSubstr("1 solid is of a material that depends on the"));
  EXPECT_EQ(entry(deck, "MAT11").used, 1);
  // Written as MAT9 in the basic axes, and as an anisotropic material, and read again.
  const DeckFolder folder;
  write_nastran(deck, folder.path() / "again.bdf");
  const Deck again = read_nastran(folder.path() / "again.bdf", deck.units);
  EXPECT_LT((elasticity_in(again, 0) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_NEAR(mass_properties(again.mesh).mass, 500, 1e-6);
  write_abaqus(deck, folder.path() / "again.inp");
  const Deck other = read_abaqus(folder.path() / "again.inp", deck.units);
  EXPECT_LT((elasticity_in(other, 0) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_NEAR(mass_properties(other.mesh).mass, 500, 1e-6);
  // A MAT9 that is the same in all directions is a MAT1.
  const Deck even = nastran(cube +
                                "PSOLID,5,7\nMAT9,7,3.+9,1.+9,1.+9,,,,3.+9\n,1.+9,,,,3.+9,,,\n"
                                ",1.+9,,,1.+9,,1.+9,500.\n",
                            "m-kg-N", {});
  EXPECT_TRUE(even.mesh.elasticities.empty());
}

// About a cylinder each solid has the axes at its centre.
TEST(SolidDecks, DirectionalMaterialsAboutACylinder) {
  const std::string solids = nastran_solids.substr(0, nastran_solids.find("GRID,9")) +
                             "GRID,9,,2.,0.,0.\nGRID,10,,2.,1.,0.\nGRID,11,,2.,1.,1.\n"
                             "GRID,12,,2.,0.,1.\nCHEXA,101,5,1,2,3,4,5,6\n,7,8\n"
                             "CHEXA,102,5,2,9,10,3,6,12\n,11,7\n";
  const std::string system = "CORD2C,3,,0.5,-0.5,0.,.5,-.5,1.\n,1.5,-.5,0.\n";
  const Deck deck = nastran(solids + system + "PSOLID,5,7,3\n" + nastran_wood);
  ASSERT_EQ(deck.mesh.elasticities.size(), 2U);
  const Elasticity above = turned(wood(), turn_about_z(90)),
                   slanting = turned(wood(), turn_about_z(45));
  EXPECT_LT((elasticity_in(deck, 0) - above).norm(), 1e-9 * above.norm());
  EXPECT_LT((elasticity_in(deck, 1) - slanting).norm(), 1e-9 * slanting.norm());
}

TEST(SolidDecks, AbaqusOrientationsOfSolids) {
  std::string wooden = abaqus_solids.substr(0, abaqus_solids.find("*MATERIAL"));
  wooden.replace(wooden.find("MATERIAL=STEEL"), 14, "MATERIAL=WOOD, ORIENTATION=GRAIN");
  wooden +=
      "*MATERIAL, NAME=WOOD\n*DENSITY\n500.\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
      "12.E9, .9E9, .5E9, .4, .45, .35, .8E9, .7E9,\n.05E9\n";
  const auto with = [&](const std::string& orientation) {
    return abaqus(wooden + "*ORIENTATION, NAME=GRAIN" + orientation);
  };
  const auto expect_turned = [&](const Deck& deck, double degrees) {
    const Elasticity expected = turned(wood(), turn_about_z(degrees));
    EXPECT_LT((elasticity_in(deck, 0) - expected).norm(), 1e-9 * expected.norm()) << degrees;
    EXPECT_NEAR(mass_properties(deck.mesh).mass, 500, 1e-6);
  };
  expect_turned(with("\n1., 0., 0., 0., 1., 0.\n"), 0);
  expect_turned(with("\n1., 0., 0., 0., 1., 0.\n3, 30.\n"), 30);
  expect_turned(with("\n0., 1., 0., -1., 0., 0.\n"), 90);
  // About an axis through (0.5, -0.5): the cube's centre lies above it.
  expect_turned(with(", SYSTEM=CYLINDRICAL\n.5, -.5, 0., .5, -.5, 1.\n"), 90);
  const auto complaints = [&](const std::string& orientation) {
    return complaints_of_abaqus(wooden + "*ORIENTATION, NAME=GRAIN" + orientation);
  };
  EXPECT_THAT(complaints(", SYSTEM=SPHERICAL\n0., 0., 0., 0., 0., 1.\n"),
              HasSubstr("SYSTEM = SPHERICAL of orientation GRAIN is not known"));
  EXPECT_THAT(complaints("\n1., 0., 0., 2., 0., 0.\n"), HasSubstr("lie on a line"));
  EXPECT_THAT(complaints_of_abaqus(wooden), HasSubstr("orientation GRAIN does not exist"));
}

TEST(SolidDecks, NastransCardsMakeQuadraticSolids) {
  const Deck deck = nastran(nastran_solids);
  ASSERT_EQ(deck.mesh.solids.size(), 3U);
  EXPECT_EQ(deck.mesh.solids[0].shape, SolidShape::hexahedron);
  EXPECT_EQ(deck.mesh.solids[1].shape, SolidShape::wedge);
  EXPECT_EQ(deck.mesh.solids[2].shape, SolidShape::tetrahedron);
  // 12 + 9 + 6 edges, of which the cube has 2 in common with the wedge and 2 with the tetrahedron.
  EXPECT_EQ(deck.mesh.vertices.size(), 12U + 12 + 9 + 6 - 4);
  EXPECT_EQ(deck.mesh.vertex_labels.size(), deck.mesh.vertices.size());
  const MeshMass mass = mass_properties(deck.mesh);
  EXPECT_NEAR(mass.mass, 7850 * (1 + 0.5 + 1 / 6.0), 1e-8 * 7850);
  const Diagnosis diagnosis = diagnose(deck.mesh, {});
  EXPECT_EQ(diagnosis.parts, 1);
  EXPECT_EQ(diagnosis.find("unused vertices"), nullptr);
  EXPECT_EQ(entry(deck, "CHEXA").used, 1);
  EXPECT_EQ(entry(deck, "PSOLID").used, 2);
  EXPECT_EQ(deck.mesh.groups.size(), 2U);
}

// Middles of edges in Nastran's order: a cube with one edge bulged by a quarter.
TEST(SolidDecks, NastransMiddlesStandWhereTheyAreTold) {
  const std::string grids =
      nastran_solids.substr(0, nastran_solids.find("GRID,9")) +
      "GRID,21,,.5,0.,0.\nGRID,22,,1.,.5,0.\nGRID,23,,.5,1.,0.\nGRID,24,,0.,.5,0.\n"
      "GRID,25,,0.,0.,.5\nGRID,26,,1.,0.,.5\nGRID,27,,1.,1.,.5\nGRID,28,,0.,1.,.5\n"
      "GRID,29,,.5,0.,1.\nGRID,30,,1.,.5,1.\nGRID,31,,.5,1.,1.\nGRID,32,,0.,.5,1.\n"
      "CHEXA,101,5,1,2,3,4,5,6\n,7,8,21,22,23,24,25,26\n,27,28,29,30,31,32\n"
      "PSOLID,5,7\nMAT1,7,206.+9,,.3,7850.\n";
  const Deck deck = nastran(grids);
  EXPECT_EQ(deck.mesh.vertices.size(), 20U);
  const Solid& solid = deck.mesh.solids.front();
  const SolidTopology& topology = topology_of(solid.shape);
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const auto place = [&](std::size_t i) { return deck.mesh.vertices[solid.vertices[i]]; };
    const Vector3 middle = 0.5 * (place(static_cast<std::size_t>(topology.edges[e][0])) +
                                  place(static_cast<std::size_t>(topology.edges[e][1])));
    EXPECT_LT((place(8 + e) - middle).norm(), 1e-12) << e;
  }
}

TEST(SolidDecks, AbaqusSolidsAndCouplingsOfTheirFaces) {
  const Deck deck = abaqus(abaqus_solids);
  ASSERT_EQ(deck.mesh.solids.size(), 1U);
  EXPECT_EQ(deck.mesh.solids[0].label, 10);
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 7850, 1e-6);
  ASSERT_EQ(deck.mesh.distributing_links.size(), 1U);
  const DistributingLink& link = deck.mesh.distributing_links[0];
  EXPECT_EQ(link.vertices.size(), 4U);
  for (const int vertex : link.vertices) EXPECT_NEAR(deck.mesh.vertices[vertex].z(), 1, 1e-12);
}

// Nodes tied to faces of solids follow the faces' own polynomial: a quadratic field comes out where
// they are, on a square face and on a triangle, though the corners alone are in the deck. One that
// is a little off the face is put onto it.
TEST(SolidDecks, NodesTiedToFacesOfSolids) {
  const std::string nodes = R"(*NODE
21, .25, .5, 1.
22, .9, .1, 1.03
23, 2.3, .2, .5
24, .5, .5, 1.6
*NSET, NSET=POINTS
21, 22, 23, 24
*NODE
11, 2., 0., 0.
12, 3., 0., 0.
13, 2., 1., 0.
14, 2., 0., 1.
*ELEMENT, TYPE=C3D4, ELSET=TETRAHEDRON
20, 11, 12, 13, 14
*SOLID SECTION, ELSET=TETRAHEDRON, MATERIAL=STEEL
*SURFACE, NAME=BOTH
CUBE, S2
TETRAHEDRON, S3
*MASS, ELSET=WEIGHTS
100.
*ELEMENT, TYPE=MASS, ELSET=WEIGHTS
101, 21
102, 22
103, 23
*SURFACE, NAME=SLAVES, TYPE=NODE
POINTS
*TIE, NAME=T
SLAVES, BOTH
)";
  const Deck deck = abaqus(abaqus_solids + nodes);
  const Mesh& mesh = deck.mesh;
  const auto vertex = [&](long label) {
    const auto& labels = mesh.vertex_labels;
    return static_cast<int>(std::find(labels.begin(), labels.end(), label) - labels.begin());
  };
  ASSERT_EQ(mesh.equations.size(), 9U);  // the fourth is too far away
  EXPECT_NEAR(mesh.vertices[vertex(22)].z(), 1, 1e-9);
  const auto field = [](const Vector3& x) {
    return 1 + x.x() - 2 * x.y() + x.x() * x.x() + 3 * x.x() * x.y() + x.z() * x.y();
  };
  for (const MotionEquation& equation : mesh.equations) {
    double sum = 0;
    for (const MotionEquation::Term& term : equation.terms)
      sum += term.of_displacement.sum() * field(mesh.vertices[term.vertex]);
    EXPECT_NEAR(sum, 0, 1e-9) << equation.terms.front().vertex;
  }
  for (const MotionEquation& equation : mesh.equations) {
    MotionEquation balanced = equation;
    EXPECT_LT(balance(mesh, balanced), 1e-9);
  }
  ASSERT_FALSE(deck.remarks.empty());
  const bool is_said =
      std::any_of(deck.remarks.begin(), deck.remarks.end(), [](const DeckRemark& remark) {
        return remark.text.find("moved onto their surface, by up to 30 mm") != std::string::npos;
      });
  EXPECT_TRUE(is_said);
}

TEST(SolidDecks, WrittenAndReadAgainTheyAreTheSame) {
  const DeckFolder folder;
  const auto expect_same_solids = [](const Deck& a, const Deck& b) {
    ASSERT_EQ(a.mesh.solids.size(), b.mesh.solids.size());
    for (std::size_t s = 0; s < a.mesh.solids.size(); ++s) {
      EXPECT_EQ(a.mesh.solids[s].shape, b.mesh.solids[s].shape);
      EXPECT_LT((places_of(a.mesh, a.mesh.solids[s]) - places_of(b.mesh, b.mesh.solids[s])).norm(),
                1e-10);
    }
    EXPECT_NEAR(mass_properties(a.mesh).mass, mass_properties(b.mesh).mass, 1e-6);
  };
  const Deck first = nastran(nastran_solids);
  write_nastran(first, folder.path() / "again.bdf");
  expect_same_solids(first, read_nastran(folder.path() / "again.bdf", first.units));
  const Deck second = abaqus(abaqus_solids);
  write_abaqus(second, folder.path() / "again.inp");
  expect_same_solids(second, read_abaqus(folder.path() / "again.inp", second.units));
}

// Two quadratic tetrahedra on either side of a face: both are to have the nodes in the middles of
// its edges, which a mesher that makes each part quadratic by itself gives twice.
TEST(SolidDecks, SaysWhichNodesTwoSolidsHaveInTheMiddleOfOneEdge) {
  const auto deck = [](const std::string& middle) {
    return "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,0.,1.,0.\n4,0.,0.,1.\n5,0.,0.,-1.\n"
           "12,.5,0.,0.\n13,0.,.5,0.\n14,0.,0.,.5\n15,0.,0.,-.5\n23,.5,.5,0.\n24,.5,0.,.5\n"
           "25,.5,0.,-.5\n34,0.,.5,.5\n35,0.,.5,-.5\n99,.5,0.,0.\n"
           "*ELEMENT, TYPE=C3D10, ELSET=S\n70,1,2,3,4,12,23,13,14,24,34\n"
           "80,1,3,2,5,13,23," +
           middle +
           ",15,35,25\n*SOLID SECTION, ELSET=S, MATERIAL=STEEL\n"
           "*MATERIAL, NAME=STEEL\n*ELASTIC\n206e9,.3\n*DENSITY\n7850.\n";
  };
  EXPECT_EQ(complaints_of_abaqus(deck("12")), "");
  const std::string said = complaints_of_abaqus(deck("99"));
  EXPECT_THAT(said, HasSubstr("deck.inp:19"));
  EXPECT_THAT(said, HasSubstr("element 80 has node 99 in the middle of the edge from node 1 to 2, "
                              "and element 70 ("));
  EXPECT_THAT(said, HasSubstr("deck.inp:18) has node 12 there"));
  EXPECT_THAT(said, HasSubstr("merge nodes that lie at one place, middles too"));
}

// The same of two quadratic shells side by side, of either deck. Two halves of a pipe have the
// nodes at their edges' ends in common and middles on opposite sides: that is no fault.
TEST(ShellDecks, SaysWhichNodesTwoShellsHaveInTheMiddleOfOneEdge) {
  const auto abaqus_deck = [](const std::string& middle) {
    return "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n5,2.,0.,0.\n6,2.,1.,0.\n"
           "12,.5,0.,0.\n23,1.,.5,0.\n34,.5,1.,0.\n14,0.,.5,0.\n25,1.5,0.,0.\n56,2.,.5,0.\n"
           "36,1.5,1.,0.\n99,1.,.5,0.\n"
           "*ELEMENT, TYPE=S8R, ELSET=S\n70,1,2,3,4,12,23,34,14\n80,2,5,6,3,25,56,36," +
           middle +
           "\n*SHELL SECTION, ELSET=S, MATERIAL=STEEL\n.01\n"
           "*MATERIAL, NAME=STEEL\n*ELASTIC\n206e9,.3\n*DENSITY\n7850.\n";
  };
  EXPECT_EQ(complaints_of_abaqus(abaqus_deck("23")), "");
  EXPECT_THAT(complaints_of_abaqus(abaqus_deck("99")),
              ::testing::AllOf(HasSubstr("element 80 has node 99 in the middle of the edge from "
                                         "node 2 to 3, and element 70 ("),
                               HasSubstr("has node 23 there")));
  const auto nastran_deck = [](const std::string& middle, double z) {
    return "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
           "GRID,12,,.5,0.,.2\nGRID,23,,1.,.5,0.\nGRID,34,,.5,1.,.2\nGRID,14,,0.,.5,0.\n" +
           fmt::format("GRID,98,,.5,0.,{0}\nGRID,99,,.5,1.,{0}\n", z) +
           "CQUAD8,70,1,1,2,3,4,12,23,\n,34,14\nCQUAD8,80,1,2,1,4,3,98,14,\n," + middle +
           ",23\nPSHELL,1,7,.01,7\nMAT1,7,206.+9,,.3,7850.\nENDDATA\n";
  };
  EXPECT_EQ(complaints_of_nastran(nastran_deck("99", -0.2)), "");  // a pipe
  EXPECT_THAT(complaints_of_nastran(nastran_deck("99", 0.2)),
              HasSubstr("element 80 has node 98 in the middle of the edge from node 1 to 2, and "
                        "element 70 ("));
}

TEST(SolidDecks, SaysWhatIsWrong) {
  const std::string grids = nastran_solids.substr(0, nastran_solids.find("CHEXA"));
  const std::string material = "MAT1,7,206.+9,,.3,7850.\n";
  EXPECT_THAT(complaints_of_nastran(grids + "CTETRA,103,6,2,12,3,2\nPSOLID,6,7\n" + material),
              HasSubstr("CTETRA: element 103 has grid 2 twice"));
  EXPECT_THAT(complaints_of_nastran(grids + "CTETRA,103,6,2,12,3,6\n" + material),
              HasSubstr("CTETRA: property 6 does not exist"));
  EXPECT_THAT(complaints_of_nastran(grids + "CTETRA,103,6,2,12,3,6\nPSHELL,6,7,.01\n" + material),
              HasSubstr("a solid has property 6, which is a PSHELL"));
  EXPECT_THAT(complaints_of_nastran(grids + "CPYRAM,103,6,1,2,3,4\nPSOLID,6,7\n" + material),
              HasSubstr("CPYRAM"));
  // Poisson's ratio of 2 with three equal moduli: it would give off energy.
  EXPECT_THAT(complaints_of_nastran(grids + "CTETRA,103,6,2,12,3,6\nPSOLID,6,7\n"
                                            "MAT11,7,2.+9,2.+9,2.+9,2.,2.,2.,1.+9\n,1.+9,1.+9\n"),
              HasSubstr("MAT11 7: the constants belong to no material"));
  EXPECT_THAT(
      complaints_of_nastran(grids + "CTETRA,103,6,2,12,3,6\nPSOLID,6,7,-1\n" + nastran_wood),
      HasSubstr("along the axes of each element (CORDM = -1)"));
  EXPECT_THAT(
      complaints_of_nastran(grids + "CQUAD4,103,6,1,2,3,4\nPSHELL,6,7,.01\n" + nastran_wood),
      HasSubstr("MAT11 7 is a material of solids; a plate takes MAT1, MAT2 or MAT8"));
  std::string without = abaqus_solids;
  without.erase(without.find("*SOLID SECTION"), 43);
  EXPECT_THAT(complaints_of_abaqus(without), HasSubstr("solids have no *SOLID SECTION"));
  // Flat as a sheet.
  EXPECT_THAT(complaints_of_nastran(grids + "CTETRA,103,6,1,2,3,4\nPSOLID,6,7\n" + material),
              HasSubstr("element 103 is folded or has no volume"));
  Deck flat = nastran(grids + "CTETRA,103,6,2,12,3,6\nPSOLID,6,7\n" + material);
  for (Vector3& vertex : flat.mesh.vertices) vertex.z() = 0;
  EXPECT_NE(diagnose(flat.mesh, {}).find("folded solids"), nullptr);
}

}  // namespace
}  // namespace blocklift::structure::test
