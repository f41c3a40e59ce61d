// Nodes and elements that Abaqus' keywords make from others; contact; materials that depend on the
// direction.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "structure/mesh/laminate.h"
#include "structure/mesh/mass_properties.h"
#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::string steel_shells =
    "*MATERIAL, NAME=STEEL\n*ELASTIC\n206.E9, .3\n*DENSITY\n7850.\n"
    "*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n.01\n";

TEST(AbaqusGeneration, ARectangleOfLinesFieldsAndRows) {
  const Deck deck = abaqus(
      "*NODE\n1, 0., 0., 0.\n5, 4., 0., 0.\n201, 0., 3., 0.\n205, 4., 3., 0.\n"
      "*NGEN, NSET=LOW\n1, 5, 1\n*NGEN, NSET=HIGH\n201, 205\n"
      "*NFILL, NSET=FIELD\nLOW, HIGH, 2, 100\n"
      "*ELEMENT, TYPE=S4\n1, 1, 2, 102, 101\n*ELGEN, ELSET=ALL\n1, 4, 1, 1, 2, 100, 10\n" +
      steel_shells);
  const Mesh& mesh = deck.mesh;
  ASSERT_THAT(mesh.vertices, SizeIs(15));
  ASSERT_THAT(mesh.shells, SizeIs(8));
  EXPECT_NEAR(mass_properties(mesh).mass, 12 * 0.01 * 7850, 1e-9);
  expect_near(mass_properties(mesh).centre, Vector3(2, 1.5, 0), 1e-12);
  // Element 13 is the third of the second row.
  const Shell& last = mesh.shells[6];
  EXPECT_EQ(last.label, 13);
  expect_near(position(mesh, last, {0.5, 0.5}), Vector3(2.5, 2.25, 0), 1e-12);
  EXPECT_EQ(entry(deck, "*ELGEN").used, 1);
}

// A quarter of a ring, copied by a shift and a turn into the next one.
TEST(AbaqusGeneration, ArcsAndCopies) {
  const Deck deck = abaqus(
      "*NODE\n1, 1., 0., 0.\n5, 0., 1., 0.\n101, 2., 0., 0.\n105, 0., 2., 0.\n99, 0., 0., 0.\n"
      "*NGEN, LINE=C, NSET=IN\n1, 5, 1, 99\n*NGEN, LINE=C, NSET=OUT\n101, 105, 1, , 0., 0., 0.\n"
      "*NSET, NSET=RING\nIN, OUT\n"
      "*NCOPY, OLD SET=RING, CHANGE NUMBER=1000, SHIFT\n0., 0., 3.\n0., 0., 0., 0., 0., 1., 90.\n"
      "*ELEMENT, TYPE=S4, ELSET=FIRST\n1, 1, 101, 102, 2\n*ELGEN, ELSET=FIRST\n1, 4, 1, 1\n"
      "*ELCOPY, OLD SET=FIRST, ELEMENT SHIFT=50, SHIFT NODES=1000, NEW SET=SECOND\n"
      "*ELSET, ELSET=ALL\nFIRST, SECOND\n" +
      steel_shells);
  const Mesh& mesh = deck.mesh;
  ASSERT_THAT(mesh.shells, SizeIs(8));
  const auto place = [&](long label) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (mesh.vertex_labels[v] == label) return mesh.vertices[v];
    return Vector3(Vector3::Constant(std::nan("")));
  };
  const double s = std::sqrt(0.5);
  expect_near(place(3), Vector3(s, s, 0), 1e-12);
  expect_near(place(103), Vector3(2 * s, 2 * s, 0), 1e-12);
  expect_near(place(1103), Vector3(-2 * s, 2 * s, 3), 1e-12);
  EXPECT_EQ(mesh.shells[4].label, 51);
}

TEST(AbaqusGeneration, WhatIsWrongIsSaidAtItsLine) {
  const std::string nodes = "*NODE, NSET=ENDS\n1, 0., 0., 0.\n5, 4., 0., 0.\n";
  const auto complaint = [&](const std::string& text) {
    return complaints_of_abaqus(nodes + text);
  };
  EXPECT_THAT(complaint("*NGEN\n1, 5, 3\n"),
              HasSubstr(":4: error: *NGEN: steps of 3 do not lead from node 1 to 5"));
  EXPECT_THAT(complaint("*NGEN\n1, 7\n"), HasSubstr(":4: error: *NGEN: node 7 does not exist"));
  EXPECT_THAT(complaint("*NGEN\n1, 5, two\n"),
              HasSubstr("*NGEN: \"two\" as the step of numbers is no whole number"));
  EXPECT_THAT(complaint("*NGEN, LINE=P\n1, 5\n"), HasSubstr("*NGEN: LINE = P is not known"));
  EXPECT_THAT(complaint("*NFILL, BIAS=.5\nENDS, ENDS, 2, 10\n"),
              HasSubstr("*NFILL: BIAS is not known"));
  EXPECT_THAT(complaint("*NFILL\nENDS, 1, 2, 10\n"),
              HasSubstr("*NFILL: the sets ENDS and 1 have 2 and 1 nodes"));
  EXPECT_THAT(complaint("*NCOPY, OLD SET=ENDS, CHANGE NUMBER=9, REFLECT=LINE\n"),
              HasSubstr("*NCOPY: REFLECT is not known"));
  EXPECT_THAT(complaint("*ELEMENT, TYPE=B31\n1, 1, 5\n*ELGEN\n1, 3\n"),
              HasSubstr("*ELGEN: element 2 names node 2, which does not exist"));
}

const std::string two_plates =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
    "11, 1., 0., .001\n12, 2., 0., .001\n13, 2., 1., .001\n14, 1., 1., .001\n"
    "*ELEMENT, TYPE=S4, ELSET=ALL\n1, 1, 2, 3, 4\n2, 11, 12, 13, 14\n"
    "*SURFACE, NAME=LEFT\n1, SPOS\n*SURFACE, TYPE=NODE, NAME=RIGHT\n11\n14\n";

// Contact joins nothing, unless it is tied: by its own word (Abaqus) or its interaction's
// (CalculiX).
TEST(AbaqusContact, TiedContactJoins) {
  const auto links = [](const Deck& deck) {
    return deck.mesh.rigid_links.size() + deck.mesh.surface_points.size();
  };
  const Deck open =
      abaqus(two_plates + steel_shells +
             "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, "
             "PRESSURE-OVERCLOSURE=HARD\n*CONTACT PAIR, INTERACTION=I\nRIGHT, LEFT\n");
  EXPECT_EQ(links(open), 0U);
  EXPECT_THAT(entry(open, "*CONTACT PAIR").left_out, HasSubstr("are not joined"));
  const Deck tied = abaqus(two_plates + steel_shells + "*TIE, NAME=T\nRIGHT, LEFT\n");
  ASSERT_GT(links(tied), 0U);
  const Deck by_word = abaqus(two_plates + steel_shells +
                              "*SURFACE INTERACTION, NAME=I\n"
                              "*CONTACT PAIR, INTERACTION=I, TIED, ADJUST=.01\nRIGHT, LEFT\n");
  const Deck by_interaction =
      abaqus(two_plates + steel_shells +
             "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.E7\n"
             "*CONTACT PAIR, INTERACTION=I\nRIGHT, LEFT\n");
  EXPECT_EQ(links(by_word), links(tied));
  EXPECT_EQ(links(by_interaction), links(tied));
  EXPECT_EQ(entry(by_word, "*CONTACT PAIR").used, 1);
}

const std::string one_shell =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
    "*ELEMENT, TYPE=S4, ELSET=ALL\n1, 1, 2, 3, 4\n";

// Constants by whatever words: of steel they are steel_shells; of a layer they are the layer's.
TEST(AbaqusMaterials, ByDirections) {
  const auto of = [&](const std::string& elastic) {
    return abaqus(one_shell + "*MATERIAL, NAME=M\n" + elastic +
                  "*DENSITY\n1600.\n*SHELL SECTION, ELSET=ALL, MATERIAL=M\n.01\n");
  };
  const Deck isotropic =
      of("*ELASTIC, TYPE=ENGINEERING CONSTANTS\n206.E9, 206.E9, 206.E9, .3, .3, .3, 79.2308E9, "
         "79.2308E9\n79.2308E9\n");
  EXPECT_TRUE(isotropic.mesh.laminates.empty());
  EXPECT_NEAR(isotropic.mesh.materials.at(0).youngs_modulus, 206e9, 1);
  EXPECT_NEAR(isotropic.mesh.materials.at(0).poisson_ratio, 0.3, 1e-12);
  // By stiffness: lambda + 2 mu, lambda, mu of E = 200 GPa, nu = 0.25: 240, 80, 80 GPa.
  const Deck by_stiffness =
      of("*ELASTIC, TYPE=ORTHOTROPIC\n240.E9, 80.E9, 240.E9, 80.E9, 80.E9, 240.E9, 80.E9, 80.E9\n"
         "80.E9\n");
  EXPECT_NEAR(by_stiffness.mesh.materials.at(0).youngs_modulus, 200e9, 1);
  EXPECT_NEAR(by_stiffness.mesh.materials.at(0).poisson_ratio, 0.25, 1e-12);
  const Deck constants =
      of("*ELASTIC, TYPE=ENGINEERING CONSTANTS\n135.E9, 10.E9, 10.E9, .3, .3, .4, 5.E9, 5.E9\n"
         "3.5E9\n");
  const Deck lamina = of("*ELASTIC, TYPE=LAMINA\n135.E9, 10.E9, .3, 5.E9, 5.E9, 3.5E9\n");
  ASSERT_THAT(constants.mesh.laminates, SizeIs(1));
  ASSERT_THAT(lamina.mesh.laminates, SizeIs(1));
  // Jones (1999), equation 2.70: Q_11 = E_1 / (1 - nu_12^2 E_2 / E_1).
  const Laminate& one = constants.mesh.laminates[0];
  EXPECT_NEAR(one.membrane(0, 0), 0.01 * 135e9 / (1 - 0.09 * 10 / 135), 1e-3);
  EXPECT_NEAR(one.bending(2, 2), 5e9 * 1e-6 / 12, 1e-6);
  expect_near(one.membrane, lamina.mesh.laminates[0].membrane, 1);
  EXPECT_NEAR(mass_properties(constants.mesh).mass, 16, 1e-9);
  EXPECT_THAT(
      complaints_of_abaqus(one_shell + "*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
                                       "1.E9, 100.E9, 100.E9, .9, .9, .9, 5.E9, 5.E9\n5.E9\n"),
      HasSubstr("the elastic constants belong to no material"));
}

// A lamina says nothing of what lies across it, and 21 constants are more than a plate has.
TEST(AbaqusMaterials, PlatesAndSolidsOfDirections) {
  EXPECT_THAT(
      complaints_of_abaqus("*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
                           "*ELEMENT, TYPE=C3D4, ELSET=ALL\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n"
                           "*ELASTIC, TYPE=LAMINA\n135.E9, 10.E9, .3, 5.E9, 5.E9, 3.5E9\n"
                           "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n"),
      HasSubstr("material M depends on the direction; an isotropic one is due"));
  EXPECT_THAT(complaints_of_abaqus(one_shell + "*MATERIAL, NAME=M\n*ELASTIC, TYPE=ANISOTROPIC\n"
                                               "10.E9, 1.E9, 20.E9, 1.E9, 1.E9, 30.E9, 0., 0.\n"
                                               "0., 4.E9, 0., 0., 0., 0., 5.E9, 0.\n"
                                               "0., 0., 0., 0., 6.E9\n"
                                               "*SHELL SECTION, ELSET=ALL, MATERIAL=M\n.01\n"),
              HasSubstr("material M is given as solids have it (ANISOTROPIC)"));
}

}  // namespace
}  // namespace blocklift::structure::test
