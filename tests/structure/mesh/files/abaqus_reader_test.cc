// Each keyword by a small deck of its own.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/laminate.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/abaqus_plate.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string &steel = abaqus_steel, &nodes = abaqus_nodes, &square_plate = abaqus_square_plate;

TEST(AbaqusReader, PlateWithSetsAndHeading) {
  const Deck deck = abaqus("*HEADING\nA plate\n** comment\n" + square_plate +
                           "*Nset, nset=Low, generate\n1, 2\n*NSET, NSET=all\nlow, 3,\n4\n");
  EXPECT_EQ(deck.title, "A plate");
  EXPECT_THAT(deck.mesh.shells.at(0).vertices, ElementsAre(0, 1, 3, 2));
  EXPECT_EQ(deck.mesh.shells[0].label, 10);
  EXPECT_EQ(deck.mesh.groups.at(0).name, "Plate");
  EXPECT_DOUBLE_EQ(deck.mesh.section_of(deck.mesh.shells[0]).thickness, 0.01);
  for (const NamedSet& set : deck.sets) {
    if (set.name != "ALL") continue;
    EXPECT_THAT(set.vertices, ElementsAre(0, 1, 2, 3));
  }
  EXPECT_EQ(entry(deck, "*ELEMENT").used, 1);
}

// Each number of such a range tried by itself takes a quarter of a minute.
TEST(AbaqusReader, RangesToTheLargestNumberTakeNoTime) {
  std::string text = square_plate + "*NSET, NSET=ODD, GENERATE\n1, 999999999, 2\n";
  for (int i = 1; i <= 20; ++i) text += fmt::format("*NSET, NSET=S{}, GENERATE\n1, 999999999\n", i);
  const auto start = std::chrono::steady_clock::now();
  const Deck deck = abaqus(text);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  const auto odd = std::find_if(deck.sets.begin(), deck.sets.end(),
                                [](const NamedSet& set) { return set.name == "ODD"; });
  ASSERT_NE(odd, deck.sets.end());
  EXPECT_EQ(odd->vertices.size(), 2U);
}

TEST(AbaqusReader, SectionsWithoutElementsAreRefused) {
  for (const std::string section : {"*SHELL SECTION, MATERIAL=Steel\n.01\n",
                                    "*SHELL SECTION, ELS?T=Plate, MATERIAL=Steel\n.01\n",
                                    "*SOLID SECTION, MATERIAL=Steel\n500.\n"})
    EXPECT_THAT([&] { abaqus(square_plate + section); },
                ::testing::ThrowsMessage<DeckError>(HasSubstr("ELSET")))
        << section;
}

TEST(AbaqusReader, OffsetsOfShells) {
  const auto offset = [&](const std::string& how) {
    std::string text = square_plate;
    text.replace(text.find("MATERIAL=Steel\n.01"), 14, "MATERIAL=Steel, OFFSET=" + how);
    return abaqus(text).mesh.shell_sections.at(0).offset;
  };
  // The nodes lie on the upper surface: the middle is below them.
  EXPECT_DOUBLE_EQ(offset("SPOS"), -0.005);
  EXPECT_DOUBLE_EQ(offset("SNEG"), 0.005);
  EXPECT_DOUBLE_EQ(offset("0.25"), -0.0025);
}

TEST(AbaqusReader, LayersOfTwoMaterials) {
  const Deck deck = abaqus(
      nodes + "*ELEMENT, TYPE=S4, ELSET=P\n10, 1, 2, 3, 4\n" + steel +
      "*MATERIAL, NAME=FOAM\n*ELASTIC\n1.e8, .3\n*DENSITY\n60.\n"
      "*SHELL SECTION, ELSET=P, COMPOSITE\n.001, 3, STEEL, 0.\n.05, 3, foam, 0.\n.001, 3, steel\n");
  ASSERT_EQ(deck.mesh.laminates.size(), 1U);
  const Material face = {"", 206e9, 0.3, 7850, 0}, foam = {"", 1e8, 0.3, 60, 0};
  const Laminate expected = stack({{isotropic_ply(face), 0.001, 0},
                                   {isotropic_ply(foam), 0.05, 0},
                                   {isotropic_ply(face), 0.001, 0}});
  expect_near(deck.mesh.laminates[0].bending, expected.bending, 1e-9 * expected.bending.norm());
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 4 * (2 * 7.85 + 3), 1e-9);
}

TEST(AbaqusReader, QuadraticShellsAndBeams) {
  const Deck deck = abaqus(
      "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 2., 0.\n4, 0., 2., 0.\n"
      "5, 1., 0., .2\n6, 2., 1., 0.\n7, 1., 2., .2\n8, 0., 1., 0.\n9, 1., 1., 0.\n"
      "*ELEMENT, TYPE=S8R, ELSET=P\n10, 1, 2, 3, 4,\n5, 6, 7, 8\n"
      "*ELEMENT, TYPE=STRI65, ELSET=P\n11, 1, 2, 4, 5, 9, 8\n"
      "*ELEMENT, TYPE=B32, ELSET=B\n12, 2, 6, 3\n" +
      steel +
      "*SHELL SECTION, ELSET=P, MATERIAL=STEEL\n.01\n"
      "*BEAM SECTION, ELSET=B, SECTION=RECT, MATERIAL=STEEL\n.1, .02\n0., 0., 1.\n");
  expect_near(position(deck.mesh, deck.mesh.shells[0], {0.5, 0}), Vector3(1, 0, 0.2), 1e-12);
  EXPECT_TRUE(deck.mesh.shells[1].is_triangle());
  ASSERT_EQ(deck.mesh.beams.size(), 2U);
  EXPECT_THAT(deck.mesh.beams[0].vertices, ElementsAre(1, 5));
  // The beam's middle node is the middle of the shell's edge: it rides there.
  ASSERT_EQ(deck.mesh.surface_points.size(), 1U);
  EXPECT_EQ(deck.mesh.surface_points[0].vertex, 5);
}

// Axis n1 is the beam's 2, n2 its 3: a rectangle of 0.1 along n1 and 0.02 along n2.
TEST(AbaqusReader, BeamSections) {
  const auto beam = [&](const std::string& section, const std::string& data) {
    const Deck deck =
        abaqus("*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n*ELEMENT, TYPE=B31, ELSET=B\n1, 1, 2\n" +
               steel + "*BEAM SECTION, ELSET=B, SECTION=" + section + ", MATERIAL=STEEL\n" + data +
               "\n0., 1., 0.\n");
    return std::pair(deck.mesh.beams.at(0), deck.mesh.section_of(deck.mesh.beams[0]));
  };
  const auto [rectangle, of_rectangle] = beam("RECT", ".1, .02");
  expect_near(rectangle.axis_2, Vector3::UnitY(), 1e-15);
  EXPECT_NEAR(of_rectangle.second_moment_3, 0.02 * 1e-3 / 12, 1e-15);
  EXPECT_NEAR(beam("PIPE", ".1, .01").second.area, std::numbers::pi * (0.01 - 0.0081), 1e-15);
  EXPECT_NEAR(beam("CIRC", ".1").second.area, std::numbers::pi * 0.01, 1e-15);
  EXPECT_NEAR(beam("BOX", ".1, .2, .01, .01, .01, .01").second.second_moment_2,
              (0.1 * 0.008 - 0.08 * std::pow(0.18, 3)) / 12, 1e-12);
  // An I whose node is at its foot: the centroid is half the height along n2, the world's z.
  const auto [i, of_i] = beam("I", "0., .4, .2, .2, .02, .02, .01");
  expect_near(i.offset[0], Vector3(0, 0, 0.2), 1e-12);
  EXPECT_NEAR(of_i.second_moment_2, i_beam(0.4, 0.01, 0.2, 0.02, 0.2, 0.02).section.second_moment_3,
              1e-15);
  // An L: its legs' middle lines meet at the node, so the shear centre does.
  const auto [l, of_l] = beam("L", ".1, .2, .01, .012");
  expect_near(Eigen::Vector2d(l.offset[0].y(), l.offset[0].z()) + of_l.shear_centre,
              Eigen::Vector2d::Zero(), 1e-12);
  EXPECT_NEAR(of_l.area, 0.1 * 0.01 + 0.19 * 0.012, 1e-12);
  EXPECT_GT(l.offset[0].y(), 0);
  EXPECT_GT(l.offset[0].z(), 0);
}

TEST(AbaqusReader, GeneralSectionsAndReleases) {
  const Deck deck = abaqus(R"(*NODE
1, 0., 0., 0.
2, 2., 0., 0.
*ELEMENT, TYPE=B31, ELSET=B
1, 1, 2
*BEAM GENERAL SECTION, ELSET=B, SECTION=GENERAL, DENSITY=7850.
.01, 1.e-6, 1.e-7, 4.e-6, 2.e-6
0., 1., 0.
206.e9, 80.e9
*CENTROID
.1, .2
*SHEAR CENTER
.1, .25
*SECTION POINTS
.2, .3
*TRANSVERSE SHEAR STIFFNESS
4.e8, 8.e8
*RELEASE
B, S1, M1-M2
1, S2, T
)");
  const Beam& beam = deck.mesh.beams.at(0);
  const BeamSection& section = deck.mesh.section_of(beam);
  EXPECT_DOUBLE_EQ(section.second_moment_2, 1e-6);
  EXPECT_DOUBLE_EQ(section.second_moment_3, 4e-6);
  EXPECT_DOUBLE_EQ(section.shear_area_3, 4e8 / 80e9);
  EXPECT_DOUBLE_EQ(section.shear_area_2, 8e8 / 80e9);
  expect_near(beam.offset[0], Vector3(0, 0.1, 0.2), 1e-12);
  expect_near(section.shear_centre, Eigen::Vector2d(0, 0.05), 1e-12);
  expect_near(section.stress_points.at(0), Eigen::Vector2d(0.1, 0.1), 1e-12);
  EXPECT_THAT(beam.release[0], ElementsAre(false, false, false, false, true, true));
  EXPECT_THAT(beam.release[1], ElementsAre(false, false, false, true, false, false));
  EXPECT_NEAR(deck.mesh.materials.at(0).shear_modulus(), 80e9, 1);
}

// What counts from the node is turned into what counts from the centroid, whichever comes first.
TEST(AbaqusReader, CentroidMayFollowTheShearCentre) {
  const Deck deck = abaqus(R"(*NODE
1, 0., 0., 0.
2, 2., 0., 0.
*ELEMENT, TYPE=B31, ELSET=B
1, 1, 2
*BEAM GENERAL SECTION, ELSET=B, SECTION=GENERAL, DENSITY=7850.
.01, 1.e-6, 1.e-7, 4.e-6, 2.e-6
0., 1., 0.
206.e9, 80.e9
*SHEAR CENTER
.1, .25
*SECTION POINTS
.2, .3
*CENTROID
.1, .2
)");
  const BeamSection& section = deck.mesh.section_of(deck.mesh.beams.at(0));
  expect_near(deck.mesh.beams[0].offset[0], Vector3(0, 0.1, 0.2), 1e-12);
  expect_near(section.shear_centre, Eigen::Vector2d(0, 0.05), 1e-12);
  expect_near(section.stress_points.at(0), Eigen::Vector2d(0.1, 0.1), 1e-12);
}

// A centroid of its own without a shear centre: where the beam twists is said.
TEST(AbaqusReader, ACentroidWithoutAShearCentreIsTold) {
  const auto remarks_with = [](const std::string& details) {
    std::string all;
    for (const auto& remark : abaqus(R"(*NODE
1, 0., 0., 0.
2, 2., 0., 0.
*ELEMENT, TYPE=B31, ELSET=B
1, 1, 2
*BEAM GENERAL SECTION, ELSET=B, SECTION=GENERAL, DENSITY=7850.
.01, 1.e-6, 1.e-7, 4.e-6, 2.e-6
0., 1., 0.
206.e9, 80.e9
)" + details)
                                  .remarks)
      all += remark.text + "\n";
    return all;
  };
  const std::string told = "*CENTROID without *SHEAR CENTER";
  EXPECT_THAT(remarks_with("*CENTROID\n.1, .2\n"), HasSubstr(told));
  EXPECT_THAT(remarks_with("*CENTROID\n0., 0.\n"), Not(HasSubstr(told)));
  EXPECT_THAT(remarks_with("*CENTROID\n.1, .2\n*SHEAR CENTER\n.1, .2\n"), Not(HasSubstr(told)));
}

TEST(AbaqusReader, MassesAndSprings) {
  const Deck deck = abaqus(nodes + R"(*ELEMENT, TYPE=MASS, ELSET=M
1, 1
*MASS, ELSET=M
12.
*ELEMENT, TYPE=ROTARYI, ELSET=R
2, 2
*ROTARY INERTIA, ELSET=R
1., 2., 3., -.1, .2, .3
*ELEMENT, TYPE=SPRING1, ELSET=S1
3, 1
*SPRING, ELSET=S1
3
100.
*ELEMENT, TYPE=SPRING2, ELSET=S2
4, 1, 3
*SPRING, ELSET=S2
4, 4
200.
*ELEMENT, TYPE=SPRINGA, ELSET=SA
5, 1, 3
*SPRING, ELSET=SA

300.
*ELEMENT, TYPE=T3D2, ELSET=T
6, 1, 2
*SOLID SECTION, ELSET=T, MATERIAL=STEEL
.002
*NONSTRUCTURAL MASS, ELSET=T, UNITS=TOTAL MASS
10.
)" + steel);
  const Mesh& mesh = deck.mesh;
  EXPECT_DOUBLE_EQ(mesh.masses.at(0).mass, 12);
  EXPECT_DOUBLE_EQ(mesh.masses.at(1).inertia(0, 1), -0.1);
  EXPECT_DOUBLE_EQ(mesh.masses.at(1).inertia(1, 2), 0.3);
  ASSERT_EQ(mesh.springs.size(), 3U);
  EXPECT_THAT(mesh.springs[0].vertices, ElementsAre(0, -1));
  EXPECT_EQ(mesh.springs[0].components[0], 2);
  EXPECT_THAT(mesh.springs[1].components, ElementsAre(3, 3));
  expect_near(mesh.springs[2].axes[0].col(0), Vector3(1, 1, 0).normalized(), 1e-12);
  EXPECT_TRUE(mesh.beams.at(0).is_rod);
  EXPECT_NEAR(mesh.section_of(mesh.beams[0]).mass_per_length, 5, 1e-12);
}

TEST(AbaqusReader, Couplings) {
  const Deck deck = abaqus(square_plate + R"(*NODE
5, 1., 1., 1.
6, 0., 0., 0.
*SURFACE, NAME=TOP, TYPE=ELEMENT
Plate, SPOS
*SURFACE, NAME=EDGE
10, E1
*SURFACE, NAME=POINTS, TYPE=NODE
3, 2.
4,
*COUPLING, CONSTRAINT NAME=A, REF NODE=5, SURFACE=TOP
*DISTRIBUTING
*COUPLING, CONSTRAINT NAME=B, REF NODE=5, SURFACE=EDGE
*KINEMATIC
1, 3
*COUPLING, CONSTRAINT NAME=C, REF NODE=5, SURFACE=POINTS
*DISTRIBUTING, COUPLING=CONTINUUM
1, 3
4, 4
*MPC
BEAM, 3, 5
TIE, 6, 1
*RIGID BODY, REF NODE=5, PIN NSET=PINS, TIE NSET=TIES
*NSET, NSET=PINS
1, 2
*NSET, NSET=TIES
3
*EQUATION
2
6, 3, 1., 1, 3, -1.
)");
  const Mesh& mesh = deck.mesh;
  ASSERT_EQ(mesh.distributing_links.size(), 2U);
  // Each corner stands for a quarter of 4 m^2.
  EXPECT_THAT(mesh.distributing_links[0].weights, ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(mesh.distributing_links[1].weights, ElementsAre(2, 1));
  EXPECT_THAT(mesh.distributing_links[1].bound, ElementsAre(true, true, true, true, false, false));
  ASSERT_EQ(mesh.rigid_links.size(), 5U);
  EXPECT_THAT(mesh.rigid_links[0].slaves, ElementsAre(0, 1));
  EXPECT_THAT(mesh.rigid_links[0].bound, ElementsAre(true, true, true, false, false, false));
  EXPECT_EQ(mesh.rigid_links[1].master, 4);
  EXPECT_THAT(mesh.rigid_links[3].slaves, ElementsAre(2));
  ASSERT_EQ(mesh.equations.size(), 1U);
  EXPECT_EQ(mesh.equations[0].terms[0].vertex, 5);
  expect_near(mesh.equations[0].terms[1].of_displacement, Vector3(0, 0, -1), 0);
  EXPECT_THAT(complaints_of_abaqus(square_plate + "*MPC\nTIE, 1, 2\n"),
              HasSubstr("TIE is not known of nodes apart"));
}

// Cylindrical nodes: radius, angle, height. Spherical ones: radius, angle about axis 3, angle from
// the plane of axes 1 and 2.
TEST(AbaqusReader, NodesOfOtherSystems) {
  const Mesh mesh = abaqus(
                        "*NODE, SYSTEM=C\n1, 2., 90., 3.\n*NODE, SYSTEM=S\n2, 2., 90., 30.\n"
                        "3, 2., 0., -60.\n")
                        .mesh;
  expect_near(mesh.vertices[0], Vector3(0, 2, 3), 1e-12);
  expect_near(mesh.vertices[1], Vector3(0, std::sqrt(3.0), 1), 1e-12);
  expect_near(mesh.vertices[2], Vector3(1, 0, -std::sqrt(3.0)), 1e-12);
}

// Two instances of one part, the second turned by 90 degrees about z after its shift.
TEST(AbaqusReader, PartsAndInstances) {
  const Deck deck = abaqus(
      "*PART, NAME=SheetPanel\n" + nodes +
      "*ELEMENT, TYPE=S4, ELSET=P\n10, 1, 2, 3, 4\n*NSET, NSET=FOOT\n1, 2\n"
      "*SHELL SECTION, ELSET=P, MATERIAL=STEEL\n.01\n*END PART\n"
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=One, PART=SheetPanel\n*END INSTANCE\n"
      "*INSTANCE, NAME=Two, PART=SheetPanel\n5., 0., 1.\n5., 0., 1., 5., 0., 2., 90.\n*END "
      "INSTANCE\n"
      "*NODE\n1, 9., 9., 9.\n"
      "*NSET, NSET=BOTH, INSTANCE=Two\n1\n*NSET, NSET=BOTH, INSTANCE=One\nFOOT\n"
      "*END ASSEMBLY\n" +
      steel +
      "*BOUNDARY\nOne.FOOT, 1, 3\nBOTH, 6\n*STEP\n*STATIC\n*CLOAD\nTwo.3, 3, -7.\n*END STEP\n");
  ASSERT_EQ(deck.mesh.vertices.size(), 9U);
  expect_near(deck.mesh.vertices[4], Vector3(5, 0, 1), 1e-12);
  expect_near(deck.mesh.vertices[5], Vector3(5, 2, 1), 1e-12);
  EXPECT_EQ(deck.mesh.shells.size(), 2U);
  EXPECT_NE(deck.mesh.vertex_labels[0], deck.mesh.vertex_labels[4]);
  ASSERT_EQ(deck.load_cases.size(), 1U);
  EXPECT_EQ(deck.support_sets.at(0).supports.size(), 5U);
  EXPECT_EQ(deck.load_sets.at(0).point_loads.at(0).vertex, 6);
  EXPECT_FALSE(deck.remarks.empty());
}

// A part's surface is one of each instance, by instance and name; pressure on one is not on both.
TEST(AbaqusReader, SurfacesOfInstances) {
  const auto deck = [&](const std::string& second, const std::string& surface) {
    return "*PART, NAME=Sheet\n" + nodes +
           "*ELEMENT, TYPE=S4, ELSET=P\n10, 1, 2, 3, 4\n*SURFACE, NAME=Top\nP, SPOS\n"
           "*SHELL SECTION, ELSET=P, MATERIAL=STEEL\n.01\n*END PART\n"
           "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=One, PART=Sheet\n*END INSTANCE\n" +
           second + "*END ASSEMBLY\n" + steel +
           "*BOUNDARY\nOne.1, 1, 6\n*STEP\n*STATIC\n*DSLOAD\n" + surface + ", P, 5.\n*END STEP\n";
  };
  const std::string second = "*INSTANCE, NAME=Two, PART=Sheet\n5., 0., 1.\n*END INSTANCE\n";
  const auto loads = [&](const std::string& text) {
    return abaqus(text).load_sets.at(0).plate_loads;
  };
  ASSERT_EQ(loads(deck(second, "Two.Top")).size(), 1U);
  EXPECT_EQ(loads(deck(second, "Two.Top"))[0].shell, 1);
  EXPECT_EQ(loads(deck("", "Top")).size(), 1U);
  EXPECT_THAT([&] { abaqus(deck(second, "Top")); },
              ::testing::ThrowsMessage<DeckError>(
                  HasSubstr("surface Top does not exist; those of the deck are ONE.TOP, TWO.TOP")));
}

TEST(AbaqusReader, IncludesFilesBelowItsFolder) {
  const DeckFolder folder;
  folder.write("deck/nodes.inc", nodes);
  const auto path = folder.write("deck/main.inp",
                                 "*INCLUDE, INPUT=nodes.inc\n" + square_plate.substr(nodes.size()));
  EXPECT_EQ(read_abaqus(path, UnitSystem()).mesh.shells.size(), 1U);
  folder.write("out.inc", nodes);
  try {
    read_abaqus(folder.write("deck/other.inp", "*INCLUDE, INPUT=../out.inc\n"), UnitSystem());
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_THAT(error.what(), HasSubstr("lies outside the deck's folder"));
  }
}

TEST(AbaqusReader, SaysEverythingThatIsWrongAtOnce) {
  const std::string text = complaints_of_abaqus(R"(*NODE
1, 0., 0., 0.
2, nan, 0., 0.
3, 0., 1.
1, 5., 5., 5.
*ELEMENT, TYPE=S3, ELSET=P
10, 1, 3, 99
*ELEMENT, TYPE=C3D8
11, 1, 1, 1, 1, 1, 1, 1, 1
*ELEMENT, TYPE=S3, ELSET=Q
12, 1, 3
*SUBMODEL
*SHELL SECTION, ELSET=P, MATERIAL=GONE
.01
*BOUNDARY
77, 1
)");
  for (const char* line : {":3: error: *NODE: \"nan\" as coordinate is no finite number",
                           ":5: error: *NODE: node 1 is there twice, first at ",
                           ":7: error: *ELEMENT: element 10 names node 99, which does not exist",
                           ":9: error: *ELEMENT: solids have no *SOLID SECTION",
                           ":11: error: *ELEMENT: element 12 of type S3 has 2 nodes; 3 are due",
                           ":12: error: the keyword *SUBMODEL is not known here",
                           ":13: error: *SHELL SECTION: material GONE does not exist",
                           ":16: error: *BOUNDARY: node 77 does not exist"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(complaints_of_abaqus(square_plate, "mm-t-N"),
              HasSubstr("Is the deck in other units?"));
  EXPECT_THAT(complaints_of_abaqus(square_plate + "*ELEMENT, TYPE=S3, ELSET=R\n20, 1, 2, 3\n"),
              HasSubstr("shells have no *SHELL SECTION"));
  EXPECT_THAT(complaints_of_abaqus("hello\n"), HasSubstr("data before the first keyword"));
}

TEST(AbaqusReader, SaysWhatToGiveForElementsThatAreNotKnown) {
  const auto said = [](const std::string& type) {
    return complaints_of_abaqus(square_plate + "*ELEMENT, TYPE=" + type + "\n99, 1, 2, 3, 4\n");
  };
  EXPECT_THAT(said("S4X"), HasSubstr("elements of type S4X are not known here (did you mean S4?)"));
  EXPECT_THAT(said("S9R5"), HasSubstr("; S8R5, without the node in the middle, is"));
  EXPECT_THAT(said("SC8R"), HasSubstr("; give S4R or S8R on the middle surface"));
  EXPECT_THAT(said("CONN3D2"), HasSubstr("; say by *COUPLING, *MPC, *EQUATION or *SPRING"));
  EXPECT_THAT(said("B31OS"), HasSubstr("; warping is not known; B31 is"));
  const Deck without = abaqus(square_plate +
                                  "*ELEMENT, TYPE=CONN3D2, ELSET=C\n99, 1, 2\n"
                                  "*CONNECTOR SECTION, ELSET=C\nBEAM,\n",
                              "m-kg-N", {.leave_out = {"CONN3D2", "CONNECTOR SECTION"}});
  EXPECT_EQ(without.mesh.shells.size(), 1U);
  EXPECT_THAT(entry(without, "*ELEMENT").left_out,
              HasSubstr("elements of type CONN3D2, as was asked for"));
}

// That the elements of a wrong section have none would only lead astray.
TEST(AbaqusReader, AWrongSectionIsSaidOnce) {
  const std::string text = complaints_of_abaqus(
      "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n*ELEMENT, TYPE=B31, ELSET=B\n1,1,2\n*MATERIAL, NAME=S\n"
      "*ELASTIC\n2e11,.3\n*BEAM SECTION, ELSET=B, MATERIAL=S, SECTION=OVAL\n1.,2.\n");
  EXPECT_THAT(text, HasSubstr("SECTION = OVAL is not known"));
  EXPECT_THAT(text, Not(HasSubstr("have no section")));
}

TEST(AbaqusReader, SpreadMassByVolume) {
  const Deck deck =
      abaqus(square_plate + "*NONSTRUCTURAL MASS, ELSET=Plate, UNITS=MASS PER VOLUME\n100.,\n");
  const double plain = mass_properties(abaqus(square_plate).mesh).mass;
  // As the plate's own steel, of 7850 kg/m^3.
  EXPECT_NEAR(mass_properties(deck.mesh).mass, plain * (1 + 100 / 7850.0), 1e-9 * plain);
}

// A part that stands twice is listed as the deck has it, once.
TEST(AbaqusReader, WhatIsUsedTwiceIsCountedOnce) {
  const Deck deck = abaqus(
      "*PART, NAME=A\n*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n*ELEMENT, TYPE=S4, "
      "ELSET=P\n1,1,2,3,4\n*SHELL SECTION, ELSET=P, MATERIAL=S\n.01\n*END PART\n*ASSEMBLY, "
      "NAME=X\n*INSTANCE, NAME=A1, PART=A\n*END INSTANCE\n*INSTANCE, NAME=A2, PART=A\n0.,0.,1.\n"
      "*END INSTANCE\n*NODE\n1, .5, .5, .5\n*END ASSEMBLY\n*MATERIAL, NAME=S\n*ELASTIC\n2e11,.3\n"
      "*DENSITY\n7850.,\n");
  EXPECT_EQ(deck.mesh.shells.size(), 2U);
  EXPECT_EQ(entry(deck, "*ELEMENT").read, 1);
  EXPECT_EQ(entry(deck, "*ELEMENT").used, 1);
  EXPECT_THAT(deck.remarks.back().text, HasSubstr("numbers of the assembly are raised by 30"));
}

// Layers along an orientation: turned about axis 3, or about a cylinder's axis.
TEST(AbaqusReader, OrientationsOfPlates) {
  const std::string wood =
      "*NODE\n1,1.,0.,0.\n2,2.,0.,0.\n3,2.,1.,0.\n4,1.,1.,0.\n*ELEMENT, TYPE=S4, ELSET=P\n"
      "1,1,2,3,4\n*SHELL SECTION, ELSET=P, COMPOSITE, ORIENTATION=O\n.02, 3, WOOD, 0.\n"
      "*MATERIAL, NAME=WOOD\n*ELASTIC, TYPE=LAMINA\n12e9,5e8,.3,7e8,7e8,6e7\n*DENSITY\n600.,\n"
      "*ORIENTATION, NAME=O";
  const auto axis = [&](const std::string& orientation) -> Vector3 {
    return abaqus(wood + orientation).mesh.shells.at(0).laminate_axis.normalized();
  };
  expect_near(axis("\n0.,2.,0., -1.,0.,0.\n"), Vector3::UnitY(), 1e-12);
  expect_near(axis("\n1.,0.,0., 0.,1.,0.\n3, 30.\n"), Vector3(std::sqrt(0.75), 0.5, 0), 1e-12);
  // The middle of the plate is at (1.5, 0.5).
  const Vector3 radial = Vector3(1.5, 0.5, 0).normalized();
  expect_near(axis(", SYSTEM=CYLINDRICAL\n0.,0.,0., 0.,0.,1.\n"), radial, 1e-12);
  expect_near(axis(", SYSTEM=CYLINDRICAL\n0.,0.,0., 0.,0.,1.\n3, 90.\n"),
              Vector3(-radial.y(), radial.x(), 0), 1e-12);
  EXPECT_THAT(complaints_of_abaqus(wood + "\n1.,0.,0., 0.,1.,0.\n1, 30.\n"),
              HasSubstr("orientation O turns about its axis 1; of plates an axis 3 that stands on "
                        "them is known"));
}

// A layer's orientation is an angle from the section's axis 1, the same as one given in degrees: by
// the sum of turned stiffnesses (Jones 1999, equation 2.85, in stack()). Straight orientations make
// one laminate of all plates, a cylinder's one for each direction.
TEST(AbaqusReader, LayersWithOrientationsOfTheirOwn) {
  const std::string plates =
      "*NODE\n1,1.,0.,0.\n2,2.,0.,0.\n3,2.,1.,0.\n4,1.,1.,0.\n5,1.,3.,0.\n6,2.,3.,0.\n"
      "*ELEMENT, TYPE=S4, ELSET=P\n1,1,2,3,4\n2,4,3,6,5\n"
      "*MATERIAL, NAME=WOOD\n*ELASTIC, TYPE=LAMINA\n12e9,5e8,.3,7e8,7e8,6e7\n*DENSITY\n600.,\n"
      "*ORIENTATION, NAME=BASE\n0.,1.,0., -1.,0.,0.\n"
      "*ORIENTATION, NAME=SLANTED\n1.,0.,0., 0.,1.,0.\n3, 30.\n"
      "*ORIENTATION, NAME=ROUND, SYSTEM=CYLINDRICAL\n0.,0.,0., 0.,0.,1.\n"
      "*SHELL SECTION, ELSET=P, COMPOSITE, ORIENTATION=BASE\n";
  const PlyMaterial wood = orthotropic_ply(12e9, 5e8, 0.3, 7e8, 7e8, 6e7, 600);
  const auto expect_layers = [&](const Laminate& laminate, double degrees) {
    const Laminate expected =
        stack({{wood, 0.01, 0}, {wood, 0.02, degrees * std::numbers::pi / 180}});
    // Angles are kept to 1e-4 rad.
    expect_near(laminate.membrane, expected.membrane, 2e-4 * expected.membrane.norm());
    expect_near(laminate.coupling, expected.coupling, 2e-4 * expected.membrane.norm() * 0.03);
    expect_near(laminate.bending, expected.bending, 2e-4 * expected.bending.norm());
  };
  // BASE is along y, so that a layer at 30 degrees from x is 60 degrees back from it.
  const Deck straight = abaqus(plates + ".01, 3, WOOD, base\n.02, 3, WOOD, SLANTED\n");
  ASSERT_EQ(straight.mesh.laminates.size(), 1U);
  expect_layers(straight.mesh.laminates[0], -60);
  for (const Shell& shell : straight.mesh.shells)
    expect_near(shell.laminate_axis.normalized(), Vector3::UnitY(), 1e-12);
  // The plates' middles are at (1.5, 0.5) and (1.5, 2).
  const Deck round = abaqus(plates + ".01, 3, WOOD\n.02, 3, WOOD, ROUND\n");
  ASSERT_EQ(round.mesh.laminates.size(), 2U);
  const auto back_from_y = [](double x, double y) {
    return -std::atan2(x, y) * 180 / std::numbers::pi;
  };
  expect_layers(round.mesh.laminates[0], back_from_y(1.5, 0.5));
  expect_layers(round.mesh.laminates[1], back_from_y(1.5, 2));
  EXPECT_NEAR(mass_properties(round.mesh).mass, 3 * 0.03 * 600, 1e-9);
  EXPECT_THAT(complaints_of_abaqus(plates + ".01, 3, WOOD, 0.\n.02, 3, WOOD, SLATED\n"),
              HasSubstr("orientation SLATED does not exist"));
}

TEST(AbaqusReader, AsksWhatWasMeantByAKeywordThatThereIsNot) {
  EXPECT_THAT(complaints_of_abaqus(square_plate + "*Boundry\n1, 1\n"),
              HasSubstr("the keyword *BOUNDRY is not known here (did you mean *BOUNDARY?)"));
  EXPECT_THAT(complaints_of_abaqus(square_plate + "*Shell Secton, elset=P\n.01\n"),
              HasSubstr("did you mean *SHELL SECTION?"));
  EXPECT_THAT(complaints_of_abaqus(square_plate + "*Connector Section, elset=C\nBEAM,\n"),
              HasSubstr("*CONNECTOR SECTION: say by *COUPLING, *MPC, *EQUATION or *SPRING what"));
}

TEST(AbaqusReader, LeavesOutUnknownKeywordsThatItsUserNames) {
  const std::string strange = square_plate + "*SUBMODEL, INTERACTION=A\nS1, S2\n";
  const Deck deck = abaqus(strange, "m-kg-N", {.leave_out = {"SUBMODEL"}});
  EXPECT_THAT(entry(deck, "*SUBMODEL").left_out, HasSubstr("as was asked for"));
  EXPECT_THAT(complaints_of_abaqus(strange, "m-kg-N"), HasSubstr("leave_out names what may"));
  try {
    abaqus(strange, "m-kg-N", {.leave_out = {"SUBMODE"}});
    ADD_FAILURE() << "it is read";
  } catch (const DeckError& error) {
    EXPECT_THAT(error.what(), HasSubstr("(did you mean SUBMODEL?)"));
  }
}

}  // namespace
}  // namespace blocklift::structure::test
