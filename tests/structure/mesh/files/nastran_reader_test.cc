// Each card by a small deck of its own.

#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double pi = std::numbers::pi;

/// A square of 2 m with one property.
const std::string square = R"(GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,2.,0.
GRID,4,,0.,2.,0.
CQUAD4,10,5,1,2,3,4
PSHELL,5,7,.01,7,,7
MAT1,7,206.+9,,.3,7850.
)";

TEST(NastranReader, FreeSmallAndLargeFieldsSayTheSame) {
  const std::string small = R"(GRID           1             0.0     0.0    -1.5
GRID           2             2.0     0.0    -1.5
GRID           3             2.0     2.0  -1.5+0
CTRIA3        10       5       1       2       3
PSHELL         5       7     .01       7               7
MAT1           7 2.06+11             0.3  7.85E3
)";
  const std::string large =
      R"(GRID*                  1                            0.D0             0.0
*              -1.500000
GRID*                  2                             2.0             0.0
*                  -1.5
GRID*                  3                             2.0            2.E0
*                -.15+1
CTRIA3*               10               5               1               2
*                      3
PSHELL*                5               7             .01               7
*                                      7
MAT1*                  7        2.06D+11                              .3
*                 7850.0
)";
  const std::string free = R"(grid, 1, , 0.0, 0.0, -1.5
grid, 2, , 2.0, 0.0, -1.5
grid*, 3, , 2.0, 2.0,
*, -1.5
ctria3, 10, 5, 1, 2, 3
pshell, 5, 7, .01, 7, , 7
mat1, 7, 2.06+11, , .3, 7850.
)";
  const Deck one = nastran(small);
  EXPECT_DOUBLE_EQ(one.mesh.vertices[2].z(), -1.5);
  EXPECT_DOUBLE_EQ(one.mesh.materials[0].youngs_modulus, 206e9);
  expect_same(one, nastran(large), 1e-15);
  expect_same(one, nastran(free), 1e-15);
}

TEST(NastranReader, ContinuationsFollowTheirCardOrNameIt) {
  const std::string grids =
      "GRID,1,,0.,0.,0.\nGRID,2,,0.,1.,0.\nGRID,3,,0.,2.,0.\n"
      "GRID,4,,0.,3.,0.\nGRID,5,,0.,4.,0.\nGRID,6,,0.,5.,0.\nGRID,7,,0.,6.,0.\n";
  const auto slaves = [&](const std::string& card) {
    return nastran(grids + card).mesh.rigid_links.at(0).slaves;
  };
  // By their order: blank, +, and free.
  EXPECT_THAT(slaves("RBE2           9       1     123       2       3       4       5       6\n"
                     "               7\n"),
              ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(slaves("RBE2,9,1,123,2,3,4,5,6,+\n+,7\n"), ElementsAre(1, 2, 3, 4, 5, 6));
  // By name, and elsewhere in the deck.
  EXPECT_THAT(
      slaves("RBE2           9       1     123       2       3       4       5       6+AB1\n"
             "$ a comment between\n+AB1           7\n"),
      ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(
      slaves("RBE2,9,1,123,2,3,4,5,6,+AB1\nCONM2,11,1,,5.,,,,+CD\n+CD,1.,,1.,,,1.\n+AB1,7\n"),
      ElementsAre(1, 2, 3, 4, 5, 6));
  // Half of a large card is left out before a small line goes on.
  const Deck half =
      nastran(grids +
              "CONM2*                11               1                             5.0\n"
              "+             1.              2.                      3.\n");
  expect_near(half.mesh.masses.at(0).inertia, Eigen::Vector3d(1, 2, 3).asDiagonal().toDenseMatrix(),
              1e-12);
  EXPECT_THAT(complaints_of_nastran(grids + "+ZZ,1,2\n"),
              HasSubstr("deck.bdf:8: error: a line continues \"ZZ\""));
  // A ninth number of free fields is no label that may be passed over.
  EXPECT_THAT(complaints_of_nastran(grids + "RBE2,9,1,123,2,3,4,5,6,7\n"),
              HasSubstr("deck.bdf:8: error: a line of free fields has more than 8 fields of data"));
}

TEST(NastranReader, SectionsBeforeBulkDataAndTitles) {
  const Deck deck = nastran(
      "$ comment\nSOL 101\nTIME 10\nCEND\nTITLE = \xc9tude du bloc\nECHO = NONE\n"
      "SUBCASE 3\n SUBTITLE = first\n SPC = 8\nBEGIN BULK\n" +
      square + "SPC1,8,123,1,2\nENDDATA\nthis is nothing\n");
  EXPECT_EQ(deck.title, "\xc9tude du bloc");
  ASSERT_EQ(deck.load_cases.size(), 1U);
  EXPECT_EQ(deck.load_cases[0].label, 3);
  EXPECT_EQ(deck.load_cases[0].title, "first");
  EXPECT_EQ(entry(deck, "case control ECHO").used, 0);
  EXPECT_TRUE(entry(deck, "case control ECHO").is_wish);
}

TEST(NastranReader, IncludesFilesBelowItsFolder) {
  const DeckFolder folder;
  folder.write("deck/parts/mesh.bdf", square);
  const auto path =
      folder.write("deck/main.bdf", "CEND\nBEGIN BULK\nINCLUDE 'parts/\n   mesh.bdf'\nENDDATA\n");
  EXPECT_EQ(read_nastran(path, unit_system("m-kg-N")).mesh.shells.size(), 1U);
  folder.write("outside.bdf", square);
  const auto refused = [&](const std::string& name) {
    try {
      read_nastran(folder.write("deck/other.bdf", "INCLUDE '" + name + "'\n"),
                   unit_system("m-kg-N"));
    } catch (const DeckError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused("../outside.bdf"),
              HasSubstr("other.bdf:1: error: INCLUDE: \"../outside.bdf\" lies outside"));
  EXPECT_THAT(refused("/etc/passwd"), HasSubstr("lies outside"));
  EXPECT_THAT(refused("nowhere.bdf"), HasSubstr("cannot be read"));
  EXPECT_THAT(refused("other.bdf"), HasSubstr("includes itself"));
}

// A point of a cylinder within a turned system within another: by turning it by hand.
TEST(NastranReader, CoordinateSystemsStandInOneAnother) {
  const Deck deck = nastran(R"(CORD2R,1,0,10.,0.,0.,10.,0.,1.
,10.,1.,0.
CORD2C,2,1,1.,2.,3.,1.,2.,4.
,2.,2.,3.
CORD2S,3,0,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD1R,4,1,2,3
GRID,1,,0.,0.,0.
GRID,2,,0.,0.,5.
GRID,3,,5.,0.,0.
GRID,11,2,2.,30.,0.5
GRID,12,3,2.,60.,90.
GRID,13,4,1.,2.,3.
)");
  // System 1: its x is the world's y, its y the world's -x, from (10, 0, 0).
  const double x = 1 + 2 * std::cos(pi / 6), y = 2 + 2 * std::sin(pi / 6), z = 3.5;
  expect_near(deck.mesh.vertices[3], Vector3(10 - y, x, z), 1e-12);
  expect_near(deck.mesh.vertices[4], Vector3(0, 2 * std::sin(pi / 3), 2 * std::cos(pi / 3)), 1e-12);
  expect_near(deck.mesh.vertices[5], Vector3(1, 2, 3), 1e-12);
}

TEST(NastranReader, CoordinateSystemsThatRestOnThemselvesAreRefused) {
  const std::string text = complaints_of_nastran(
      "CORD2R,1,2,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2R,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "CORD2R,3,0,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,1,9,0.,0.,0.\n");
  EXPECT_THAT(text, HasSubstr("deck.bdf:1: error: coordinate system 1 rests on itself"));
  EXPECT_THAT(
      text,
      HasSubstr("deck.bdf:5: error: the three points of the coordinate system lie on a line"));
  EXPECT_THAT(text, HasSubstr("deck.bdf:7: error: coordinate system 9 does not exist"));
}

// Displacements about a cylinder: component 1 at 90 degrees is the world's y.
TEST(NastranReader, SupportsAndLoadsOfACylinder) {
  const Deck deck = nastran(R"(CEND
SPC = 1
LOAD = 2
BEGIN BULK
CORD2C,1,,0.,0.,0.,0.,0.,1.
,1.,0.,0.
GRID,1,1,2.,90.,0.,1
GRID,2,1,2.,0.,0.
SPC,1,1,1,0.25
FORCE,2,2,1,10.,1.,2.,3.
FORCE,2,1,1,10.,1.,2.,3.
)");
  const Support& support = deck.support_sets.at(0).supports.at(0);
  expect_near(support.axes.col(0), Vector3::UnitY(), 1e-12);
  expect_near(support.axes.col(1), -Vector3::UnitX(), 1e-12);
  EXPECT_DOUBLE_EQ(support.value[0], 0.25);
  expect_near(deck.load_sets.at(0).point_loads.at(0).force, Vector3(10, 20, 30), 1e-12);
  expect_near(deck.load_sets.at(0).point_loads.at(1).force, Vector3(-20, 10, 30), 1e-12);
  ASSERT_EQ(deck.load_cases.size(), 1U);
}

TEST(NastranReader, ShellsWithOffsetsAndThicknessesAtCorners) {
  const std::string more =
      "CQUAD4,11,5,1,2,3,4,,.02\n,,,.012,.012,.012,.012\n"
      "CTRIA3,12,5,1,2,3,,-.03\n,,1,1.2,1.2,1.2\n"
      "CQUAD4,13,5,1,2,3,4\n,,,.01,.01005,.01,.01005\n";
  const Deck deck = nastran(square + more);
  const auto section = [&](std::size_t i) { return deck.mesh.section_of(deck.mesh.shells[i]); };
  EXPECT_DOUBLE_EQ(section(0).thickness, 0.01);
  EXPECT_DOUBLE_EQ(section(1).thickness, 0.012);
  EXPECT_DOUBLE_EQ(section(1).offset, 0.02);
  EXPECT_DOUBLE_EQ(section(2).thickness, 0.012);
  EXPECT_DOUBLE_EQ(section(2).offset, -0.03);
  EXPECT_NEAR(section(3).thickness, 0.010025, 1e-15);
  EXPECT_TRUE(deck.mesh.shells[2].is_triangle());
  EXPECT_THAT(deck.mesh.shells[0].vertices, ElementsAre(0, 1, 3, 2));
  const Deck sloping = nastran(square + "CQUAD4,11,5,1,2,3,4\n,,,.01,.02,.01,.02\n");
  EXPECT_DOUBLE_EQ(sloping.mesh.section_of(sloping.mesh.shells.back()).thickness, 0.015);
  EXPECT_THAT(sloping.mesh.shell_tapers, ElementsAre(ElementsAre(.01, .02, .02, .01)));
}

// Mass and centre by hand: plate of 4 m^2, 10 mm, with 5 kg/m^2 on it; bar of 3 m; a point mass.
TEST(NastranReader, MassAndCentreByHand) {
  const Deck deck = nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,2000.,0.,0.
GRID,3,,2000.,2000.,0.
GRID,4,,0.,2000.,0.
GRID,5,,0.,0.,3000.
CQUAD4,10,5,1,2,3,4,,100.
PSHELL,5,7,10.,7,,7,,5.-9
CBAR,11,6,1,5,1.,0.,0.
,,,200.,0.,0.,200.,0.,0.
PBAR,6,7,1000.,1.+6,1.+6,1.+5,1.-6
CONM2,12,5,,.1,0.,500.
MAT1,7,206000.,,.3,7.85-9
)",
                            "mm-t-N");
  const double plate = 4 * (0.01 * 7850 + 5), bar = 3 * (0.001 * 7850 + 1), point = 100;
  const MeshMass mass = mass_properties(deck.mesh);
  EXPECT_NEAR(mass.mass, plate + bar + point, 1e-9);
  const Vector3 centre =
      (plate * Vector3(1, 1, 0.1) + bar * Vector3(0.2, 0, 1.5) + point * Vector3(0, 0.5, 3)) /
      (plate + bar + point);
  expect_near(mass.centre, centre, 1e-12);
}

// Each number of such a range tried by itself takes a quarter of a minute.
TEST(NastranReader, RangesToTheLargestNumberTakeNoTime) {
  std::string text = square;
  for (int i = 1; i <= 20; ++i) text += fmt::format("SPC1,{},123,1,THRU,999999999\n", i);
  text += "RBE2,90,1,123,2,THRU,999999999\nPLOAD2,3,7.,10,THRU,999999999\n";
  const auto start = std::chrono::steady_clock::now();
  const Deck deck = nastran(text);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  EXPECT_EQ(deck.support_sets.at(19).supports.size(), deck.mesh.vertices.size());
  EXPECT_EQ(deck.mesh.rigid_links.at(0).slaves.size(), deck.mesh.vertices.size() - 1);
}

// A list of Eigen's that an error leaves half given ends a build with assertions.
TEST(NastranReader, DamagedStiffnessIsRefused) {
  EXPECT_THAT(
      [&] { nastran(square + "CTRIA3,11,6,1,2,3\nPSHELL,6,3,.01\nMAT2,3,2.06+5,,0.3,7.85-90.\n"); },
      ::testing::ThrowsMessage<DeckError>(HasSubstr("stiffness")));
}

TEST(NastranReader, LoadsAndSubcases) {
  const Deck deck =
      nastran("CEND\nSPC = 1\nSUBCASE 1\n LOAD = 10\nSUBCASE 2\n SPC = 2\n LOAD = 3\nBEGIN BULK\n" +
              square + R"(CTRIA3,11,5,1,2,3
SPC1,1,123456,1,THRU,3
SPC1,4,3,4
SPCADD,2,1,4
LOAD,10,2.,1.5,3,-1.,5
FORCE,3,1,,100.,0.,0.,-1.
MOMENT,3,1,,10.,0.,1.,0.
PLOAD4,5,10,1.,2.,3.,4.
PLOAD4,5,11,6.,,,,,
,,0.,0.,2.
PLOAD2,3,7.,10,THRU,11
GRAV,5,,9.81,0.,0.,-1.
FORCE1,3,2,50.,2,3
PLOAD,5,12.,1,2,3,4
)");
  ASSERT_EQ(deck.load_cases.size(), 2U);
  EXPECT_THAT(deck.load_cases[0].loads, ElementsAre(std::pair(0, 3.0), std::pair(1, -2.0)));
  EXPECT_THAT(deck.load_cases[1].loads, ElementsAre(std::pair(0, 1.0)));
  EXPECT_EQ(deck.load_cases[0].supports.size(), 1U);
  EXPECT_EQ(deck.load_cases[1].supports.size(), 2U);
  EXPECT_EQ(deck.support_sets.at(0).supports.size(), 3U);
  const LoadSet &three = deck.load_sets.at(0), &five = deck.load_sets.at(1);
  expect_near(three.point_loads[0].force, Vector3(0, 0, -100), 1e-12);
  expect_near(three.point_loads[1].moment, Vector3(0, 10, 0), 1e-12);
  expect_near(three.point_loads[2].force, Vector3(0, 50, 0), 1e-12);
  EXPECT_EQ(three.plate_loads.size(), 2U);
  EXPECT_THAT(five.plate_loads[0].pressure, ElementsAre(1, 2, 4, 3));
  expect_near(five.plate_loads[1].direction, Vector3::UnitZ(), 1e-15);
  expect_near(five.gravity, Vector3(0, 0, -9.81), 1e-15);
  EXPECT_EQ(five.point_loads.size(), 4U);
  expect_near(five.point_loads[0].force, Vector3(0, 0, 12), 1e-12);
}

TEST(NastranReader, EquationsBetweenFreedoms) {
  // Vertical motion of the middle as the mean of the ends', whose weights have four digits; set 5
  // is asked for by nothing.
  const std::string points =
      "GRID,1,,0.,0.,0.\nGRID,2,,1000.,0.,0.\nGRID,3,,3000.,0.,0.\nGRID,4,,0.,0.,0.\n";
  const Deck deck = nastran("CEND\nMPC = 4\nSPC = 1\nBEGIN BULK\n" + points +
                                "MPC,4,2,3,1.,1,3,-.6667\n,,3,3,-.3333\nMPC,4,4,5,2.,1,5,-2.\n"
                                "MPC,5,1,1,1.,2,2,3.\nSPC1,1,1,1\n",
                            "mm-t-N");
  ASSERT_EQ(deck.mesh.equations.size(), 2U);
  const MotionEquation& mean = deck.mesh.equations[0];
  ASSERT_EQ(mean.terms.size(), 3U);
  EXPECT_EQ(mean.terms[0].vertex, 1);
  expect_near(mean.terms[0].of_displacement, Vector3(0, 0, 1), 0);
  expect_near(mean.terms[1].of_displacement, Vector3(0, 0, -2.0 / 3), 1e-12);
  expect_near(mean.terms[2].of_displacement, Vector3(0, 0, -1.0 / 3), 1e-12);
  // A factor of a rotation counts in the deck's lengths.
  expect_near(deck.mesh.equations[1].terms[0].of_rotation, Vector3(0, 0.002, 0), 1e-18);
  // One that resists motions of the whole holds it: no lift has such.
  const Deck held = nastran(points + "MPC,5,1,1,1.,2,2,3.\n");
  EXPECT_TRUE(held.mesh.equations.empty());
  ASSERT_EQ(held.holding_equations.size(), 1U);
  EXPECT_THAT(held.holding_equations[0].place, HasSubstr("deck.bdf:5"));
  expect_near(held.holding_equations[0].equation.terms[1].of_displacement, Vector3(0, 3, 0), 0);
}

TEST(NastranReader, UnitsAndTheirPlausibility) {
  const std::string mm =
      "GRID,1,,0.,0.,0.\nGRID,2,,2000.,0.,0.\nGRID,3,,2000.,2000.,0.\n"
      "CTRIA3,10,5,1,2,3\nPSHELL,5,7,10.,7,,7\nMAT1,7,206000.,,.3,7.85-9\n";
  const Mesh mesh = nastran(mm, "mm-t-N").mesh;
  EXPECT_DOUBLE_EQ(mesh.vertices[1].x(), 2);
  EXPECT_NEAR(mesh.materials[0].density, 7850, 1e-9);
  EXPECT_NEAR(mesh.materials[0].youngs_modulus, 206e9, 1);
  EXPECT_THAT(complaints_of_nastran(mm, "m-kg-N"),
              HasSubstr("deck.bdf:6: error: MAT1: MAT1 7 has a Young's modulus of 0.206 MPa if "
                        "units are m-kg-N"));
  EXPECT_THAT(complaints_of_nastran(square, "mm-t-N"), HasSubstr("Is the deck in other units?"));
  const std::string inches =
      "GRID,1,,0.,0.,0.\nGRID,2,,100.,0.,0.\nGRID,3,,100.,100.,0.\n"
      "CTRIA3,10,5,1,2,3\nPSHELL,5,7,.5,7,,7\nMAT1,7,3.+7,,.3,.284\n";
  EXPECT_THAT(complaints_of_nastran(inches, "in-lbf"), HasSubstr("or does it give weights?"));
  const Deck weighed = nastran("PARAM,WTMASS,.00259\n" + inches, "in-lbf");
  EXPECT_NEAR(weighed.mesh.materials[0].density, 7860, 10);
  const std::string of_case = "CEND\nPARAM, WTMASS , .00259\nBEGIN BULK\n" + inches + "ENDDATA\n";
  EXPECT_NEAR(nastran(of_case, "in-lbf").mesh.materials[0].density, 7860, 10);
  EXPECT_THAT(complaints_of_nastran("CEND\nPARAM,WTMASS,x\nBEGIN BULK\n" + inches, "in-lbf"),
              HasSubstr("the value of WTMASS must be positive"));
  EXPECT_THROW(unit_system("cm"), ModelError);
  EXPECT_DOUBLE_EQ(unit_system("m-t-kN").mass(), 1e3);
  EXPECT_DOUBLE_EQ(unit_system("m-kt-MN").stress(), 1e6);
  EXPECT_DOUBLE_EQ(unit_system("m-kt-MN").density(), 1e6);
}

// A density in kg/m^3 where t/mm^3 are due: what uses the material does not say so again.
TEST(NastranReader, AWrongMaterialIsSaidOnce) {
  const std::string text = complaints_of_nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2000.,0.,0.\nGRID,3,,2000.,2000.,0.\n"
      "CTRIA3,10,5,1,2,3\nCTRIA3,11,6,1,2,3\nCBAR,12,8,1,2,0.,0.,1.\nPSHELL,5,7,10.,7,,7\n"
      "PSHELL,6,7,12.,7,,7\nPBAR,8,7,100.,1000.,1000.,1000.\nMAT1,7,206000.,,.3,7850.\n",
      "mm-t-N");
  EXPECT_THAT(text, HasSubstr("deck.bdf:10: error: MAT1: MAT1 7 has a density of 7.85e+15 kg/m^3"));
  EXPECT_THAT(text, Not(HasSubstr("times)")));
  EXPECT_EQ(text.find("error", text.find("error") + 1), std::string::npos) << text;
}

TEST(NastranReader, AShearModulusOfItsOwnIsSaid) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2000.,0.,0.\nGRID,3,,2000.,2000.,0.\n"
      "CTRIA3,10,5,1,2,3\nPSHELL,5,7,10.,7,,7\nMAT1,7,208000.,79600.,.3,7.85-9\n",
      "mm-t-N");
  std::string remarks;
  for (const auto& remark : deck.remarks) remarks += remark.text + "\n";
  EXPECT_THAT(remarks,
              HasSubstr("MAT1 7: G is 0.5 % less than what E and nu give; E and nu are used\n"));
}

TEST(NastranReader, SaysEverythingThatIsWrongAtOnce) {
  const std::string text = complaints_of_nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,nan,0.,0.
GRID,3,,1.,inf,0.
GRID,1,,1.,1.,0.
GRID,4,,1.+400,0.,0.
CQUAD4,10,5,1,99,1,1
CTRIA3,11,6,1,1,1
WEIRD,1,2,3
CHEXA,12,5,1,98,3,4,5,6
CBAR,13,5,1,1,1.,0.,0.
PSHELL,6,9,.01
SPC1,1,789,1
)");
  for (const char* line :
       {":2: error: GRID: \"nan\" as coordinate (field 4 of line 1) is no finite number",
        ":3: error: GRID: \"inf\"", ":4: error: GRID: grid 1 is there twice, first at ",
        ":5: error: GRID: \"1.+400\"",
        ":6: error: CQUAD4: CQUAD4 10 names grid 99, which does not exist",
        ":7: error: CTRIA3: CTRIA3 11 has two corners in one grid",
        ":8: error: the card WEIRD is not known here", ":9: error: CHEXA: ",
        ":10: error: CBAR: CBAR 13 has no length", ":12: error: SPC1: \"789\" as components"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(complaints_of_nastran(square + "CTRIA3,11,6,1,2,3\nCTRIA3,12,6,1,2,3\n"),
              HasSubstr("deck.bdf:8: error: CTRIA3: property 6 does not exist (2 times)"));
  EXPECT_THAT(complaints_of_nastran("CEND\nLOAD = 7\nBEGIN BULK\n" + square),
              HasSubstr("load set 7 does not exist"));
  EXPECT_THAT(complaints_of_nastran("CEND\n"), HasSubstr("the deck has no grids"));
  EXPECT_THROW(read_nastran("/nowhere/deck.bdf", UnitSystem()), DeckError);
}

// A decimal comma in a small field makes the whole line one of free fields.
TEST(NastranReader, SaysThatACommaDividesALine) {
  EXPECT_THAT(complaints_of_nastran(square + "GRID    9               1.0     0.0     0,0\n"),
              HasSubstr("the line has a comma, so that its fields end at commas, and \"GRID    9"));
}

TEST(NastranReader, NamesThePropertyThatLacksADimension) {
  EXPECT_THAT(complaints_of_nastran(square + "CBEAM,9,9,1,2,0.,0.,1.\nPBEAML,9,7,,I\n,.1,.2,.3\n"),
              HasSubstr("PBEAML 9: the dimension is missing"));
}

TEST(NastranReader, LeavesOutUnknownCardsThatItsUserNames) {
  EXPECT_THAT(complaints_of_nastran(square + "CBEND,9,9,1,2,0.,0.,1.,1\n"),
              HasSubstr("CBEND: curved bars are not known; make straight CBAR or CBEAM"));
  const std::string strange = square + "BCTABLE,1\nBCTABLE,2\nCBEND,9,9,1,2,0.,0.,1.,1\n";
  const DeckOptions options{.leave_out = {"BCTABLE", "CBEND"}};
  const Deck deck = nastran(strange, "m-kg-N", options);
  EXPECT_EQ(entry(deck, "BCTABLE").read, 2);
  EXPECT_THAT(entry(deck, "BCTABLE").left_out, HasSubstr("as was asked for"));
  EXPECT_THAT(entry(deck, "CBEND").left_out, HasSubstr("as was asked for"));
  const auto complaints = [&](const std::vector<std::string>& names) -> std::string {
    try {
      nastran(strange, "m-kg-N", {.leave_out = names});
    } catch (const DeckError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaints({"CBEND"}), HasSubstr("leave_out names what may be missing (2 times)"));
  EXPECT_THAT(complaints({"BCTABLE"}), HasSubstr("make straight CBAR or CBEAM"));
  EXPECT_THAT(
      complaints({"BCTABLE", "CBEMD"}),
      HasSubstr("leave_out names CBEMD, which the deck does not have (did you mean CBEND?)"));
  EXPECT_THAT(complaints({"BCTABLE", "CBEND", "CGAP"}),
              HasSubstr("leave_out names CGAP, which the deck does not have"));
  EXPECT_THAT(complaints({"BCTABLE", "CBEND", "CQUAD4"}),
              HasSubstr("leave_out names CQUAD4, which is known here"));
}

// As a public deck of MYSTRAN's has them.
TEST(NastranReader, AsksWhatWasMeantByACardThatThereIsNot) {
  EXPECT_THAT(complaints_of_nastran(square + "CQAUD4,11,6,1,2,3,4\n"),
              HasSubstr("the card CQAUD4 is not known here (did you mean CQUAD4?): what it says"));
  EXPECT_THAT(complaints_of_nastran(square + "GIRD,11,,1.,2.,3.\n"), HasSubstr("mean GRID?"));
  EXPECT_THAT(complaints_of_nastran(square + "PARM,POST,-1\n"), HasSubstr("mean PARAM?"));
  // There are such cards, near as their names may be to others.
  EXPECT_THAT(complaints_of_nastran(square + "CBEAM3,11,6,1,2,3\n"),
              HasSubstr("CBEAM3: beams of three grids are not known; make two CBEAM of each"));
  EXPECT_THAT(complaints_of_nastran(square + "CQUADX,11,6,1,2,3,4\n"), Not(HasSubstr("did you")));
}

TEST(NastranReader, BlanksBetweenComponents) {
  const Deck deck = nastran(square + "SPC1    998     12 456  1       2\nDEBUG   192     2\n");
  ASSERT_FALSE(deck.support_sets.empty());
  EXPECT_THAT(deck.support_sets.front().supports.front().held,
              ElementsAre(true, true, false, true, true, true));
  EXPECT_THAT(entry(deck, "DEBUG").left_out, HasSubstr("printed"));
}

// Points without a place, and springs that end on them; tables, and properties that no element has.
TEST(NastranReader, LeavesOutWhatHangsOnNothing) {
  const Deck deck = nastran(square +
                            "SPOINT,100,THRU,102\nEPOINT,200,205\nCELAS3,46,14,101,102\n"
                            "CELAS2,47,9.,1,1,205,0\nCELAS2,48,9.,1,1,2,1\nPBEND,70,1\n"
                            "TABLEM4,45,0.,.1\nSPC1,3,0,100,200\nSPC1,3,3,1\n");
  EXPECT_THAT(entry(deck, "SPOINT").left_out, HasSubstr("without a place"));
  EXPECT_THAT(entry(deck, "CELAS2").left_out, HasSubstr("points without a place"));
  EXPECT_THAT(entry(deck, "PBEND").left_out, HasSubstr("elements that are not known"));
  EXPECT_THAT(entry(deck, "TABLEM4").left_out, HasSubstr("a table"));
  EXPECT_EQ(deck.mesh.springs.size(), 1U);
  ASSERT_EQ(deck.support_sets.size(), 1U);
  EXPECT_EQ(deck.support_sets[0].supports.size(), 1U);
}

TEST(NastranReader, NumberedLayersAreLayers) {
  const std::string corners = square.substr(0, square.find("PSHELL"));
  const std::string material = "MAT1,7,206.+9,,.3,7850.\n";
  const Deck plain = nastran(corners + material + "PCOMP,5\n+,7,.01,,,7,.02\n+,7,.03\n");
  const Deck numbered = nastran(corners + material + "PCOMPG,5\n+,1,7,.01\n+,2,7,.02\n+,4,7,.03\n");
  EXPECT_DOUBLE_EQ(numbered.mesh.shell_sections.at(0).thickness, 0.06);
  EXPECT_EQ(numbered.mesh.shell_sections.at(0).thickness,
            plain.mesh.shell_sections.at(0).thickness);
  EXPECT_EQ(numbered.mesh.shell_sections.at(0).laminate, -1);
}

// What is wrong with an element is said of the element, not of each load on it, too.
TEST(NastranReader, LoadsOnElementsThatFailAreNotComplainedOf) {
  const std::string text = complaints_of_nastran(square +
                                                 "CQUAD4,11,6,1,2,3,4\nPLOAD2,3,2.,11\n"
                                                 "PLOAD4,3,77,1.\nPLOAD1,3,78,FX,FR,0.,1.,1.,1.\n");
  EXPECT_THAT(text, HasSubstr("property 6 does not exist"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("PLOAD2")));
  EXPECT_THAT(text,
              HasSubstr("PLOAD4: a pressure of set 3 is on element 77, which does not exist"));
  EXPECT_THAT(text, HasSubstr("PLOAD1: a load of set 3 is on element 78, which does not exist"));
}

// Bars of composites have a G of their own: E / (2 G) - 1 is no Poisson's ratio of a plate.
TEST(NastranReader, MaterialsOfBarsMayHaveAnyG) {
  const std::string bar = "CBAR,20,7,1,2,0.,0.,1.\nPBARL,7,8,MSCBML0,TUBE\n+,.1,.08\n";
  const std::string stiff = "MAT1,8,58.+9,7.3+9,,1600.\n";
  const Deck deck = nastran(square + bar + stiff);
  const Material& material =
      deck.mesh.materials[deck.mesh.section_of(deck.mesh.beams.at(0)).material];
  EXPECT_NEAR(material.shear_modulus(), 7.3e9, 1);
  EXPECT_NEAR(material.youngs_modulus, 58e9, 1);
  Mesh mesh = deck.mesh;
  for (Material& one : mesh.materials) one.yield_stress = 235e6;
  EXPECT_NO_THROW(check_mesh(mesh));
  EXPECT_THAT(complaints_of_nastran(square + "CTRIA3,11,6,1,2,3\nPSHELL,6,8,.01,8\n" + stiff),
              HasSubstr("MAT1 8 has Poisson's ratio 2.97"));
}

TEST(NastranReader, CoresOfSandwichesAreSoftAlongThePlate) {
  const std::string sandwich =
      "CTRIA3,11,6,1,2,3\nPSHELL,6,7,.001,7,1415.,8,22.2\nMAT8,8,.69+6,.69+6,.1,.69+6,3.1+8,1.5+8,"
      "50.\n";
  EXPECT_EQ(complaints_of_nastran(square + sandwich), "");
  // Faces of woven cloth at 45 degrees, whose nearest isotropic plate would have a ratio of 0.98.
  const std::string cloth =
      "CTRIA3,11,6,1,2,3\nPSHELL,6,9,.001,9,1415.,8,22.2\nMAT8,8,.69+6,.69+6,.1,.69+6,3.1+8,1.5+8,"
      "50.\nMAT8,9,117.+9,117.+9,.98,2.3+9,1.2+9,1.2+9,1600.\n";
  EXPECT_EQ(complaints_of_nastran(square + cloth), "");
}

TEST(NastranReader, LeavesOutCommandsToTheSolverThatAreNotThere) {
  const Deck deck = nastran(
      "INCLUDE 'write_modes.v2005'\nSOL 103\nCEND\nTITLE = A\n"
      "SET 8 = 1 THRU 9,\n  12,13 THRU 20, \n 30\nINCLUDE 'more.inc'\nBEGIN BULK\n" +
      square + "ENDDATA\n");
  EXPECT_THAT(entry(deck, "INCLUDE").left_out, HasSubstr("commands to the solver"));
  EXPECT_THAT(describe_ledger(deck), ::testing::Not(HasSubstr("case control 12")));
  EXPECT_THAT(complaints_of_nastran("CEND\nBEGIN BULK\nINCLUDE 'gone.bdf'\n" + square),
              HasSubstr("\"gone.bdf\" to be included cannot be read"));
}

// No lift has the loads of a deck: those that cannot be said here do not keep it from being read.
TEST(NastranReader, LeavesOutLoadsThatItCannotSay) {
  const Deck deck = nastran(square +
                            "CBAR,20,7,1,2,0.,0.,1.\nPBAR,7,7,.01,1.-5,1.-5,1.-5\n"
                            "PLOAD1,3,20,FZ,FR,0.,5.,1.,5.\n"
                            "PLOAD4,3,10,2.,,,,,,+\n+,,,,,LINE,TANG\n");
  EXPECT_THAT(entry(deck, "PLOAD4").left_out, HasSubstr("SORL"));
  ASSERT_EQ(deck.load_sets.size(), 1U);
  EXPECT_EQ(deck.load_sets[0].beam_loads.size(), 1U);
}

TEST(NastranReader, LeavesOutWhatHasNoMeaningHereAndSaysSo) {
  const Deck deck = nastran(square +
                                "DESVAR,1,T1,1.,.1,5.\nCAERO1,1,1\nCAERO1,2,1\nPLOTEL,1,1,2\n"
                                "PARAM,POST,-1\nCHEXA,12,5,1,2,3,4,5,6\nMAT1,9,2.+11,,.3\n",
                            "m-kg-N", {.leave_solids_out = true});
  EXPECT_EQ(entry(deck, "CAERO1").read, 2);
  EXPECT_EQ(entry(deck, "CAERO1").used, 0);
  EXPECT_THAT(entry(deck, "CAERO1").left_out, HasSubstr("aeroelasticity"));
  EXPECT_THAT(entry(deck, "DESVAR").left_out, HasSubstr("optimisation"));
  EXPECT_THAT(entry(deck, "CHEXA").left_out, HasSubstr("solids"));
  EXPECT_EQ(entry(deck, "MAT1").read, 2);
  EXPECT_EQ(entry(deck, "MAT1").used, 1);
  EXPECT_EQ(entry(deck, "CQUAD4").used, 1);
  EXPECT_THAT(entry(deck, "CQUAD4").left_out, ::testing::IsEmpty());
  EXPECT_THAT(describe_ledger(deck), HasSubstr("CAERO1"));
}

TEST(NastranReader, ADeckWithoutPropertiesAsksForThem) {
  const Deck deck = nastran(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\n"
      "$HMNAME PROP                   5\"side plating\" 4\n"
      "CTRIA3,10,5,1,2,3\nCTRIA3,11,6,1,2,3\n");
  EXPECT_EQ(deck.mesh.shells[0].section, -1);
  EXPECT_THAT(deck.groups_without_thickness, ElementsAre("side plating", "property 6"));
}

}  // namespace
}  // namespace blocklift::structure::test
