// Decks that are cut off, empty, or written by editors and exports that do as they like.

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;

const std::string square_of_abaqus =
    "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
    "*ELEMENT, TYPE=S4, ELSET=P\n7, 1, 2, 3, 4\n"
    "*SHELL SECTION, ELSET=P, MATERIAL=Steel\n.01\n"
    "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.\n";
const std::string square_of_nastran =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "CQUAD4,7,5,1,2,3,4\nPSHELL,5,7,.01,7,,7\nMAT1,7,206.+9,,.3,7850.\nENDDATA\n";

TEST(BrokenDecks, EmptyOnes) {
  EXPECT_THAT(complaints_of_nastran(""), HasSubstr("the deck has no grids"));
  EXPECT_THAT(complaints_of_abaqus(""), HasSubstr("the deck has no nodes"));
  EXPECT_THAT(complaints_of_abaqus("** a comment\n"), HasSubstr("the deck has no nodes"));
}

TEST(BrokenDecks, AnElementThatIsCutOff) {
  const std::string nodes = square_of_abaqus.substr(0, square_of_abaqus.find("*ELEMENT"));
  EXPECT_THAT(complaints_of_abaqus(nodes + "*ELEMENT, TYPE=S8R, ELSET=P\n7, 1, 2, 3, 4,\n"),
              HasSubstr("deck.inp:7: error: *ELEMENT: element 7 ends after 4 of 8 nodes"));
  EXPECT_THAT(
      complaints_of_abaqus(nodes + "*ELEMENT, TYPE=S4, ELSET=P\n7, 1, 2"),
      HasSubstr("deck.inp:7: error: *ELEMENT: element 7 of type S4 has 2 nodes; 4 are due"));
}

TEST(BrokenDecks, AStepThatIsCutOff) {
  const std::string begun = square_of_abaqus + "*STEP\n*STATIC\n*CLOAD\n2, 3, 100.";
  EXPECT_THAT(complaints_of_abaqus(begun), HasSubstr("deck.inp:18: error: the deck is cut off"));
  EXPECT_THAT(complaints_of_abaqus(begun), HasSubstr("deck.inp:15) has no *END STEP"));
  const Deck deck = abaqus(begun + "\n");
  EXPECT_THAT(deck.remarks.at(0).text, HasSubstr("*STEP has no *END STEP: is the deck all there?"));
  EXPECT_TRUE(abaqus(begun + "\n*ENDSTEP").remarks.empty());
}

// Parts stand in the model by their instances alone.
TEST(BrokenDecks, PartsWithoutInstances) {
  const std::string parts = "*PART, NAME=Sheet\n" + square_of_abaqus + "*END PART\n";
  EXPECT_THAT(complaints_of_abaqus(parts),
              HasSubstr("deck.inp:1: error: *PART: no *INSTANCE takes part \"SHEET\""));
  EXPECT_THAT(complaints_of_abaqus(parts + "*ASSEMBLY, NAME=A\n*END ASSEMBLY\n"),
              HasSubstr("no *INSTANCE takes part"));
}

// Windows' editors begin a file with the mark of UTF-8, and end lines with a return.
TEST(BrokenDecks, MarksOfEditors) {
  const auto for_windows = [](std::string text) {
    for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
      text.insert(i, "\r");
    return "\xEF\xBB\xBF" + text;
  };
  EXPECT_EQ(complaints_of_nastran(for_windows(square_of_nastran)), "");
  EXPECT_EQ(complaints_of_abaqus(for_windows(square_of_abaqus)), "");
  // Those of old Macintoshes end them in a return alone.
  std::string returns = square_of_abaqus;
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  EXPECT_EQ(abaqus(returns).mesh.shells.size(), 1U);
}

// A keyword goes on behind a comma, but never in another keyword.
TEST(BrokenDecks, AKeywordThatEndsInACommaTooMany) {
  std::string text = square_of_abaqus;
  text.insert(text.find("\n*ELASTIC"), ",");
  EXPECT_EQ(complaints_of_abaqus(text), "");
}

TEST(BrokenDecks, NumbersBeyondTheGreatest) {
  EXPECT_THAT(complaints_of_abaqus(square_of_abaqus + "*NODE\n1000000000, 0., 0., 0.\n"),
              HasSubstr("\"1000000000\" as node is no number from 1 to 999999999"));
  EXPECT_THAT(complaints_of_nastran("GRID,1000000000,,0.,0.,0.\n" + square_of_nastran),
              HasSubstr("is no number from 1 to 999999999"));
  EXPECT_EQ(complaints_of_abaqus(square_of_abaqus + "*NODE\n999999999, 0., 0., 5.\n"), "");
}

// What names a grid whose card is wrong is not said to be wrong, too.
TEST(BrokenDecks, AWrongGridIsSaidOnce) {
  const std::string text = complaints_of_nastran(R"(GRID,1,,0.,0.,0.
GRID,2,,1.,x0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
CORD1R,7,1,2,4
CQUAD4,1,1,1,2,3,4
PSHELL,1,1,.01,1
MAT1,1,2.1+11,,.3,7850.
CONM2,7,2,,5.
RBE2,8,2,123,3,4
CELAS2,11,1.+5,2,1
MPC,5,2,1,1.,3,1,-1.
FORCE,1,2,,1.,0.,0.,1.
PLOAD4,1,1,5.
SPC1,2,123456,2,4
)");
  EXPECT_THAT(text, HasSubstr(":2: error: GRID: \"x0.\" as coordinate"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << text;
}

}  // namespace
}  // namespace blocklift::structure::test
