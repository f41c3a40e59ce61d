// Lines of data in files of their own, keywords of steps that there are not, the spread mass of
// solids, and the shear stiffness that a shell's section is given.

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/laminate.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string steel_of_plate = "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n";
const std::string plate_of_two =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 2., 0., 0.\n"
    "6, 2., 1., 0.\n*ELEMENT, TYPE=S4R, ELSET=A\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n" +
    steel_of_plate + "*SHELL SECTION, ELSET=A, MATERIAL=Steel\n.01\n";
const std::string box_of_two =
    "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
    "6, 2., 0., 1.\n7, 2., 1., 1.\n8, 0., 1., 1.\n*ELEMENT, TYPE=C3D8, ELSET=E\n"
    "1, 1, 2, 3, 4, 5, 6, 7, 8\n" +
    steel_of_plate + "*SOLID SECTION, ELSET=E, MATERIAL=Steel\n";

std::string complaints_of_file(const std::filesystem::path& path) {
  try {
    read_abaqus(path, UnitSystem());
  } catch (const DeckError& error) {
    return error.what();
  }
  return {};
}

TEST(AbaqusData, KeywordsReadTheFileThatInputNames) {
  const DeckFolder folder;
  folder.write("more/nodes.txt", "** a comment\n7, 3., 0., 0.\n\n8, 3., 1., 0.\n");
  folder.write("elements.txt", "3, 5, 7, 8, 6\n");
  folder.write("means.txt", "3\n2, 3, 1., 1, 3, -.5, 5, 3, -.5\n");
  folder.write("pairs.txt", "BEAM, 8, 7\n");
  folder.write("held.txt", "1, 1, 6\n");
  folder.write("forces.txt", "5, 3, -20.\n");
  folder.write("pressures.txt", "A, P, 3.\n");
  const Deck deck = read_abaqus(
      folder.write("deck.inp", plate_of_two +
                                   "*NODE, INPUT=more\\nodes.txt, NSET=X\n9, 4., 0., 0.\n"
                                   "*NSET, NSET=Y\nX\n"
                                   "*ELEMENT, TYPE=S4R, ELSET=A, INPUT=\"elements.txt\"\n"
                                   "*EQUATION, INPUT=means.txt\n*MPC, INPUT=pairs.txt\n"
                                   "*BOUNDARY, INPUT=held.txt\n*STEP\n*STATIC\n"
                                   "*CLOAD, INPUT=forces.txt\n*DLOAD, INPUT=pressures.txt\n"
                                   "*END STEP\n"),
      UnitSystem());
  EXPECT_EQ(deck.files.size(), 8U);
  // Those of the file stand before those below the keyword.
  ASSERT_EQ(deck.mesh.vertices.size(), 9U);
  expect_near(deck.mesh.vertices[7], Vector3(3, 1, 0), 1e-12);
  const auto set = std::find_if(deck.sets.begin(), deck.sets.end(),
                                [](const NamedSet& one) { return one.name == "Y"; });
  ASSERT_NE(set, deck.sets.end());
  EXPECT_THAT(set->vertices, ElementsAre(6, 7, 8));
  EXPECT_EQ(deck.mesh.shells.size(), 3U);
  EXPECT_EQ(deck.mesh.equations.size(), 1U);
  EXPECT_EQ(deck.mesh.rigid_links.size(), 1U);
  EXPECT_EQ(deck.support_sets.at(0).supports.size(), 1U);
  ASSERT_EQ(deck.load_sets.size(), 1U);
  EXPECT_DOUBLE_EQ(deck.load_sets[0].point_loads.at(0).force.z(), -20);
  EXPECT_EQ(deck.load_sets[0].plate_loads.size(), 3U);
}

TEST(AbaqusData, FilesOfDataAreGuardedLikeThoseThatAreIncluded) {
  const DeckFolder folder;
  folder.write("outside.txt", "5, 1, 100.\n");
  folder.write("deck/wrong.txt", "** forces\n5, 1, 1OO.\n");
  folder.write("deck/keywords.txt", "5, 1, 100.\n*CLOAD\n6, 1, 100.\n");
  const auto said = [&](const std::string& parameters) {
    return complaints_of_file(folder.write(
        "deck/deck.inp", plate_of_two + "*STEP\n*CLOAD" + parameters + "\n*END STEP\n"));
  };
  EXPECT_THAT(said(", INPUT=../outside.txt"),
              HasSubstr("deck.inp:19: error: *CLOAD: \"../outside.txt\" lies outside the deck's"));
  EXPECT_THAT(said(", INPUT=gone.txt"),
              HasSubstr("deck.inp:19: error: *CLOAD: the file \"gone.txt\" to be included cannot"));
  EXPECT_THAT(said(", INPUT=deck.inp"),
              HasSubstr("deck.inp:19: error: *CLOAD: \"deck.inp\" includes itself"));
  EXPECT_THAT(said(", INPUT="), HasSubstr("*CLOAD: INPUT = file is missing"));
  EXPECT_THAT(said(", INPUT=wrong.txt"),
              HasSubstr("wrong.txt:2: error: *CLOAD: \"1OO.\" as value is no finite number"));
  EXPECT_THAT(said(", INPUT=keywords.txt"),
              HasSubstr("keywords.txt:2: error: \"*CLOAD\" in the file of INPUT = of *CLOAD"));
  // What is left out is not looked for.
  EXPECT_THAT(said("\n5, 1, 100.\n*AMPLITUDE, NAME=A, INPUT=gone.txt"), ::testing::IsEmpty());
}

TEST(AbaqusData, ParametersThatAreNotReadAreSaid) {
  const auto remarks = [](const std::string& more) {
    std::string all;
    for (const DeckRemark& remark : abaqus(plate_of_two + more).remarks)
      all += remark.place.substr(remark.place.find("deck.inp")) + ": " + remark.text + "\n";
    return all;
  };
  EXPECT_THAT(remarks(""), ::testing::IsEmpty());
  EXPECT_THAT(remarks("*NSET, NSET=X, INTERNAL, gene rate\n1, 3\n"), ::testing::IsEmpty());
  EXPECT_EQ(remarks("*NODE, NSTE=X\n7, 5., 5., 5.\n"),
            "deck.inp:18: *NODE: the parameter NSTE is not read (did you mean NSET?)\n");
  EXPECT_EQ(remarks("*STEP\n*CLOAD, LOAD CASE=2\n5, 1, 1.\n*END STEP\n"),
            "deck.inp:19: *CLOAD: the parameter LOAD CASE is not read\n");
  std::string symmetric = plate_of_two;
  symmetric.replace(symmetric.find("MATERIAL=Steel"), 14, "COMPOSITE, SYMMETRIC");
  EXPECT_THAT(complaints_of_abaqus(symmetric), HasSubstr("SYMMETRIC is not known"));
}

TEST(AbaqusData, KeywordsOfStepsThatThereAreNotAreErrors) {
  const auto step = [](const std::string& keywords) {
    return plate_of_two + "*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n" + keywords +
           "*CLOAD\n6, 1, 500.\n*END STEP\n";
  };
  EXPECT_THAT(complaints_of_abaqus(step("*CLAOD\n5, 1, 1000.\n")),
              HasSubstr("deck.inp:22: error: the keyword *CLAOD is not known here (did you mean "
                        "*CLOAD?)"));
  EXPECT_THAT(complaints_of_abaqus(step("*DLAOD\nA, P, .1\n")),
              HasSubstr("the keyword *DLAOD is not known here (did you mean *DLOAD?)"));
  EXPECT_THAT(complaints_of_abaqus(step("*LOAD CASE, NAME=A\n")),
              HasSubstr("*LOAD CASE: give each load case of a step a step of its own"));
  const Deck deck = abaqus(step("*CHANGE FRICTION\n*SELECTEIGENMODES\n1\n"));
  EXPECT_THAT(entry(deck, "*CHANGE FRICTION").left_out, HasSubstr("what a step does beyond"));
  EXPECT_THAT(entry(deck, "*SELECT EIGENMODES").left_out, HasSubstr("what a step does beyond"));
  EXPECT_EQ(deck.load_cases.size(), 1U);
  // It is a step's alone.
  EXPECT_THAT(complaints_of_abaqus(plate_of_two + "*CHANGE FRICTION\n"),
              HasSubstr("*CHANGE FRICTION: it is known in steps alone, and stands in none"));
}

// What changes the structure or its loads from step to step is not left out unasked.
TEST(AbaqusData, ElementsThatGoAndOtherChangesAreErrors) {
  const auto step = [](const std::string& keywords) {
    return plate_of_two + "*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n" + keywords +
           "*CLOAD\n6, 1, 500.\n*END STEP\n";
  };
  EXPECT_THAT(
      complaints_of_abaqus(step("*MODEL CHANGE, REMOVE\nA\n")),
      HasSubstr("deck.inp:22: error: *MODEL CHANGE: elements that go and come again are not "
                "known"));
  EXPECT_THAT(complaints_of_abaqus(step("*INERTIA RELIEF\n")),
              HasSubstr("*INERTIA RELIEF: hold the model by supports"));
  DeckOptions options;
  options.leave_out = {"MODEL CHANGE"};
  const Deck asked = abaqus(step("*MODEL CHANGE, REMOVE\nA\n"), "m-kg-N", options);
  EXPECT_EQ(asked.load_cases.size(), 1U);
  for (const char* harmless :
       {"*MODEL CHANGE, ACTIVATE\n", "*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nS1, S2\n"})
    EXPECT_THAT(entry(abaqus(step(harmless)), "*MODEL CHANGE").left_out,
                HasSubstr("of contact, or for restarts alone"));
}

// A box of 2 m^3.
TEST(AbaqusData, SpreadMassOfSolids) {
  const auto mass = [](const std::string& spread) {
    return mass_properties(abaqus(box_of_two + spread).mesh).mass;
  };
  EXPECT_NEAR(mass(""), 15700, 1e-6);
  EXPECT_NEAR(mass("*NONSTRUCTURAL MASS, ELSET=E, UNITS=MASS PER VOLUME\n100.\n"), 15900, 1e-6);
  EXPECT_NEAR(mass("*NONSTRUCTURAL MASS, ELSET=E, UNITS=TOTAL MASS\n500.\n"), 16200, 1e-6);
  EXPECT_THAT(
      complaints_of_abaqus(box_of_two + "*NONSTRUCTURAL MASS, ELSET=E, UNITS=MASS PER AREA\n5.\n"),
      HasSubstr("*NONSTRUCTURAL MASS: UNITS = MASS PER AREA of these elements (0 shells, 0 beams, "
                "1 solids) is not known"));
}

// By default in proportion to what the elements weigh: a light cube, a heavy one, and a plate.
TEST(AbaqusData, ATotalIsSpreadByMassOrVolume) {
  const std::string cubes =
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n"
      "6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n9, 0., 0., 2.\n10, 1., 0., 2.\n"
      "11, 1., 1., 2.\n12, 0., 1., 2.\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "*ELEMENT, TYPE=C3D8, ELSET=F\n2, 5, 6, 7, 8, 9, 10, 11, 12\n*ELEMENT, TYPE=S4, ELSET=P\n"
      "3, 1, 2, 3, 4\n*ELSET, ELSET=ALL\nE, F, P\n" +
      steel_of_plate +
      "*MATERIAL, NAME=LIGHT\n*ELASTIC\n70.e9, .3\n*DENSITY\n2700.\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=Steel\n*SOLID SECTION, ELSET=F, MATERIAL=LIGHT\n"
      "*SHELL SECTION, ELSET=P, MATERIAL=LIGHT\n.01\n"
      "*NONSTRUCTURAL MASS, ELSET=ALL, UNITS=TOTAL MASS";
  const Mesh by_mass = abaqus(cubes + "\n100.\n").mesh;
  const double share = 100 / (7850 + 2700 + 27.0);
  EXPECT_NEAR(by_mass.materials[by_mass.solids[0].material].density, 7850 * (1 + share), 1e-9);
  EXPECT_NEAR(by_mass.materials[by_mass.solids[1].material].density, 2700 * (1 + share), 1e-9);
  EXPECT_NEAR(by_mass.section_of(by_mass.shells[0]).mass_per_area, 27 * share, 1e-9);
  const Mesh by_volume = abaqus(cubes + ", DISTRIBUTION=VOLUME PROPORTIONAL\n100.\n").mesh;
  EXPECT_NEAR(by_volume.materials[by_volume.solids[0].material].density, 7850 + 100 / 2.01, 1e-9);
  EXPECT_NEAR(by_volume.materials[by_volume.solids[1].material].density, 2700 + 100 / 2.01, 1e-9);
  EXPECT_NEAR(mass_properties(by_volume).mass, 7850 + 2700 + 27 + 100, 1e-8);
}

// Only the elements of the set get heavier, and stay as stiff.
TEST(AbaqusData, SpreadMassLeavesOtherSolidsOfTheMaterial) {
  const Deck deck = abaqus(
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 0., 0., -1.\n"
      "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n2, 1, 3, 2, 5\n*ELSET, ELSET=LAST\n2\n" +
      steel_of_plate +
      "*SOLID SECTION, ELSET=E, MATERIAL=Steel\n"
      "*NONSTRUCTURAL MASS, ELSET=LAST, UNITS=MASS PER VOLUME\n60.\n");
  const Mesh& mesh = deck.mesh;
  const Material &first = mesh.materials[mesh.solids.at(0).material],
                 &last = mesh.materials[mesh.solids.at(1).material];
  EXPECT_DOUBLE_EQ(first.density, 7850);
  EXPECT_DOUBLE_EQ(last.density, 7910);
  EXPECT_DOUBLE_EQ(last.youngs_modulus, first.youngs_modulus);
  EXPECT_NEAR(mass_properties(mesh).mass, (7850 + 7910) / 6.0, 1e-8);
}

TEST(AbaqusData, ShearStiffnessOfShells) {
  const auto shear = [](const std::string& data) -> Eigen::Matrix2d {
    const Deck deck = abaqus(
        "*NODE\n1, 0., 0., 0.\n2, 1000., 0., 0.\n3, 1000., 1000., 0.\n4, 0., 1000., 0.\n"
        "*ELEMENT, TYPE=S4R, ELSET=A\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n206000., "
        ".3\n*DENSITY\n7.85e-9\n"
        "*SHELL SECTION, ELSET=A, MATERIAL=M\n10.\n*TRANSVERSE SHEAR STIFFNESS\n" +
            data + "\n",
        "mm-t-N");
    EXPECT_EQ(entry(deck, "*TRANSVERSE SHEAR STIFFNESS").used, 1);
    return deck.mesh.laminates.at(0).shear;
  };
  Eigen::Matrix2d expected;
  expected << 3e6, 1e5, 1e5, 4e6;  // N/m
  expect_near(shear("3000., 4000., 100."), expected, 1e-6);
  // One that is not given is as the other.
  expect_near(shear("3000."), 3e6 * Eigen::Matrix2d::Identity(), 1e-6);
  expect_near(shear("0., 2000."), 2e6 * Eigen::Matrix2d::Identity(), 1e-6);
}

TEST(AbaqusData, ShearStiffnessLeavesWhatAPlateHasOtherwise) {
  const Deck deck = abaqus(plate_of_two + "*TRANSVERSE SHEAR STIFFNESS\n1.e6, 1.e6, 0.\n");
  ASSERT_EQ(deck.mesh.laminates.size(), 1U);
  const Laminate plain = homogeneous({"", 206e9, 0.3, 7850, 0}, 0.01);
  const Laminate& own = deck.mesh.laminates[0];
  expect_near(own.membrane, plain.membrane, 1e-9 * plain.membrane.norm());
  expect_near(own.bending, plain.bending, 1e-9 * plain.bending.norm());
  EXPECT_NEAR(mass_properties(deck.mesh).mass, 2 * 78.5, 1e-9);
  EXPECT_THAT(complaints_of_abaqus(plate_of_two + "*TRANSVERSE SHEAR STIFFNESS\n1., 1., 2.\n"),
              HasSubstr("deck.inp:18: error: *TRANSVERSE SHEAR STIFFNESS: K11 = 1, K22 = 1, "
                        "K12 = 2: K11 and K22 must be positive"));
  EXPECT_THAT(complaints_of_abaqus(plate_of_two + "*BOUNDARY\n1, 1\n*TRANSVERSE SHEAR STIFFNESS\n"),
              HasSubstr("deck.inp:20: error: *TRANSVERSE SHEAR STIFFNESS: it is to follow a "
                        "section of shells or beams, and follows none"));
}

// Layers keep theirs but for the shear.
TEST(AbaqusData, ShearStiffnessOfLayers) {
  const std::string layers =
      "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 2., 0.\n4, 0., 2., 0.\n"
      "*ELEMENT, TYPE=S4, ELSET=P\n10, 1, 2, 3, 4\n" +
      steel_of_plate +
      "*MATERIAL, NAME=FOAM\n*ELASTIC\n1.e8, .3\n*DENSITY\n60.\n"
      "*SHELL SECTION, ELSET=P, COMPOSITE\n.001, 3, STEEL, 0.\n.05, 3, FOAM, 0.\n.001, 3, STEEL\n";
  const Laminate plain = abaqus(layers).mesh.laminates.at(0);
  const Mesh mesh = abaqus(layers + "*TRANSVERSE SHEAR STIFFNESS\n5.e6, 6.e6\n").mesh;
  ASSERT_EQ(mesh.laminates.size(), 1U);
  expect_near(mesh.laminates[0].bending, plain.bending, 1e-12 * plain.bending.norm());
  expect_near(mesh.laminates[0].shear.diagonal(), Eigen::Vector2d(5e6, 6e6), 1e-6);
}

// A step lacks what is left out of it: that is said at the keyword's line.
TEST(AbaqusData, LoadsThatAreLeftOutAreSaidAtTheirLine) {
  const Deck deck = abaqus(plate_of_two + "*STEP\n*STATIC\n*DLOAD\nA, VP, 5.\n*END STEP\n");
  const auto said = std::find_if(deck.remarks.begin(), deck.remarks.end(), [](const auto& remark) {
    return remark.text.find("*DLOAD: a load VP is left out") != std::string::npos;
  });
  ASSERT_NE(said, deck.remarks.end());
  EXPECT_THAT(said->place, HasSubstr("deck.inp:20"));
  EXPECT_EQ(entry(deck, "*DLOAD").is_wish, false);
}

// CalculiX: the displacements of the second node are the body's rotations.
TEST(AbaqusData, RotationNodesOfRigidBodies) {
  const std::string body =
      plate_of_two +
      "*NODE\n100, 3., .5, 0.\n101, 3., .5, 0.\n*NSET, NSET=END\n5, 6\n"
      "*EQUATION\n2\n101, 2, 1., 1, 5, -1.\n"
      "*RIGID BODY, NSET=END, REF NODE=100, ROT NODE=101\n*BOUNDARY\n101, 1, 1, .02\n";
  const Deck deck = abaqus(body + "*STEP\n*STATIC\n*CLOAD\n101, 3, 50.\n*END STEP\n");
  constexpr int reference = 6;
  ASSERT_EQ(deck.mesh.vertex_labels.at(reference), 100);
  ASSERT_EQ(deck.mesh.rigid_links.size(), 1U);
  EXPECT_EQ(deck.mesh.rigid_links[0].master, reference);
  const Support& support = deck.support_sets.at(0).supports.at(0);
  EXPECT_EQ(support.vertex, reference);
  EXPECT_THAT(support.held, ElementsAre(false, false, false, true, false, false));
  EXPECT_DOUBLE_EQ(support.value[3], 0.02);
  const PointLoad& load = deck.load_sets.at(0).point_loads.at(0);
  EXPECT_EQ(load.vertex, reference);
  expect_near(load.moment, Vector3(0, 0, 50), 1e-12);
  EXPECT_TRUE(load.force.isZero(0));
  ASSERT_EQ(deck.mesh.equations.size(), 1U);
  EXPECT_EQ(deck.mesh.equations[0].terms[0].vertex, reference);
  expect_near(deck.mesh.equations[0].terms[0].of_rotation, Vector3(0, 1, 0), 1e-12);
  EXPECT_THAT(complaints_of_abaqus(body + "*STEP\n*STATIC\n*CLOAD\n101, 4, 1.\n*END STEP\n"),
              HasSubstr("freedom 4 of node 101, the ROT NODE of a rigid body"));
}

}  // namespace
}  // namespace blocklift::structure::test
