// Abaqus decks as Gmsh writes them: meshes of surfaces without properties.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two plates at a right angle as Gmsh writes them: lines along edges, faces as plane elements, its
// own sets and those of physical groups, no properties.
const std::string surfaces_of_gmsh = R"(*Heading
 plates.inp
*NODE
1, 0, 0, 0
2, 2, 0, 0
3, 2, 1, 0
4, 0, 1, 0
5, 0, 0, 0.5
6, 2, 0, 0.5
7, 1, 0, 0
******* E L E M E N T S *************
*ELEMENT, type=T3D3, ELSET=Line1
1, 1, 7, 2
*ELEMENT, type=CPS3, ELSET=Surface1
2, 1, 2, 3
3, 1, 3, 4
*ELEMENT, type=CPS4, ELSET=Surface2
4, 1, 2, 6, 5
*ELSET,ELSET=edge
1
*ELSET,ELSET=bottom
2, 3
*ELSET,ELSET=side
4
*NSET,NSET=edge
1, 2, 7
)";

TEST(GmshSurfaces, AreShells) {
  const Deck plain = abaqus(surfaces_of_gmsh);
  EXPECT_EQ(plain.mesh.shells.size(), 3U);
  EXPECT_TRUE(plain.mesh.beams.empty());
  EXPECT_THAT(plain.groups_without_thickness, ElementsAre("shells"));
  EXPECT_THAT(entry(plain, "*ELEMENT").left_out, HasSubstr("lines of type T3D3"));
  ASSERT_EQ(plain.remarks.size(), 1U);
  EXPECT_THAT(plain.remarks[0].text, HasSubstr("which Gmsh writes for any surface"));

  // Whose sets are given a thickness or a section are of these groups, whatever the capitals.
  const DeckOptions options{.groups_of_plates = {"Bottom", "side"}, .groups_of_bars = {"edge"}};
  const Deck given = abaqus(surfaces_of_gmsh, "m-kg-N", options);
  EXPECT_THAT(given.groups_without_thickness, ElementsAre("Bottom", "side"));
  EXPECT_THAT(given.groups_without_section, ElementsAre("edge"));
  ASSERT_EQ(given.mesh.shells.size(), 3U);
  EXPECT_EQ(given.mesh.group_of_region(given.mesh.shells[1].region).name, "Bottom");
  EXPECT_EQ(given.mesh.group_of_region(given.mesh.shells[2].region).name, "side");
  EXPECT_EQ(given.mesh.beams.size(), 2U);  // its middle is on no edge of a quadratic plate

  // Two thicknesses for one plate are one too many.
  try {
    abaqus(surfaces_of_gmsh, "m-kg-N", {.groups_of_plates = {"side", "surface2"}});
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_THAT(error.what(), HasSubstr("in the sets side and surface2, each of which is given"));
  }
}

// With a section the same faces are plates of it; bodies in plane stress are no plates.
TEST(GmshSurfaces, TakeSectionsOfShells) {
  const std::string steel = "*MATERIAL, NAME=S\n*ELASTIC\n206.E9, .3\n*DENSITY\n7850.\n";
  const std::string sections = steel + "*SHELL SECTION, ELSET=bottom, MATERIAL=S\n.012\n" +
                               "*SHELL SECTION, ELSET=side, MATERIAL=S\n.01\n";
  std::string faces = surfaces_of_gmsh;
  for (const std::string line :
       {"*ELEMENT, type=T3D3, ELSET=Line1\n1, 1, 7, 2\n", "*ELSET,ELSET=edge\n1\n"})
    faces.erase(faces.find(line), line.size());
  const Deck deck = abaqus(faces + sections);
  expect_mass(deck, 7850 * (2 * 0.012 + 0.01), 7850 * Vector3(0.034, 0.012, 0.0025));
  // Its lines are named, and may be left out.
  EXPECT_THAT(complaints_of_abaqus(surfaces_of_gmsh + sections),
              HasSubstr("beams or trusses have no section; leave_out: [T3D3] does without"));
  EXPECT_EQ(
      abaqus(surfaces_of_gmsh + sections, "m-kg-N", {.leave_out = {"T3D3"}}).mesh.beams.size(), 0U);
  EXPECT_THAT(complaints_of_abaqus(faces + steel + "*SOLID SECTION, ELSET=side, MATERIAL=S\n.01\n"),
              HasSubstr("element 4 is a CPS4 of a plane body, which cannot be lifted"));
}

// As a Nastran deck the curves are bars without a property, of second order without a direction.
TEST(GmshSurfaces, OfNastranHaveNoBars) {
  const Deck deck = nastran(R"($ Created by Gmsh
GRID    1       0       0.00E+000.00E+000.00E+00
GRID    2       0       2.0000000.00E+000.00E+00
GRID    3       0       2.0000001.0000000.00E+00
GRID    4       0       0.00E+001.0000000.00E+00
GRID    5       0       1.0000000.00E+000.00E+00
CBAR    1       1       1       5       0.      0.      0.
CBAR    2       1       1       2       5
CQUAD4  3       1       1       2       3       4
ENDDATA
)");
  EXPECT_EQ(deck.mesh.shells.size(), 1U);
  EXPECT_TRUE(deck.mesh.beams.empty());
  EXPECT_THAT(deck.groups_without_thickness, ElementsAre("property 1"));
  EXPECT_EQ(entry(deck, "CBAR").used, 0);
  EXPECT_THAT(entry(deck, "CBAR").left_out, HasSubstr("the deck has no properties at all"));
}

}  // namespace
}  // namespace blocklift::structure::test
