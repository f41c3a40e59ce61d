// Nastran's loads that say nothing, are left out or are wrong, and what else is said of them.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/structure/mesh/files/deck_text.h"

namespace blocklift::structure::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string plate_and_bar =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,2.,0.\nGRID,4,,0.,2.,0.\n"
    "CQUAD4,10,5,1,2,3,4\nPSHELL,5,7,.01,7,,7\nMAT1,7,206.+9,,.3,7850.\n"
    "CBAR,20,8,1,2,0.,0.,1.\nPBAR,8,7,.01,1.-5,1.-5,1.-5\nSPC1,1,123456,1,4\n";

std::string with_case(const std::string& cards, int load) {
  return "CEND\nSPC = 1\nLOAD = " + std::to_string(load) + "\nBEGIN BULK\n" + plate_and_bar +
         cards + "ENDDATA\n";
}

TEST(NastranLoads, ALoadWithoutDirectionIsRefused) {
  const auto said = [](const std::string& cards) {
    return complaints_of_nastran(plate_and_bar + cards);
  };
  EXPECT_THAT(said("FORCE,3,2,,100.,0.,0.,0.\n"),
              HasSubstr("deck.bdf:11: error: FORCE: the direction of a load of set 3 (fields 6 to "
                        "8) is 0., 0., 0.; at least one component must not be zero"));
  EXPECT_THAT(said("FORCE,3,2,,100.\n,0.,0.,1.\n"),
              HasSubstr("FORCE: the direction of a load of set 3 (fields 6 to 8) is blank, blank, "
                        "blank; at least one"));
  EXPECT_THAT(said("MOMENT,3,2,,100.,,0.\n"), HasSubstr("is blank, 0., blank; at least one"));
  EXPECT_THAT(said("GRAV,3,,9.81\n"),
              HasSubstr("GRAV: the direction of a load of set 3 (fields 5 to 7) is blank, blank, "
                        "blank; at least one"));
  EXPECT_THAT(said("RFORCE,3,1,,2.\n"), HasSubstr("RFORCE: the direction of a load of set 3"));
  // A load of no size needs none.
  EXPECT_THAT(said("FORCE,3,2,,0.\nGRAV,3,,0.\n"), IsEmpty());
}

TEST(NastranLoads, FieldsBeyondACardsEndAreSaid) {
  const Deck deck = nastran(plate_and_bar + "FORCE,3,2,,100.,0.,0.,1.\n,0.,0.,1.\nENDDATA\n");
  ASSERT_EQ(deck.remarks.size(), 1U);
  EXPECT_THAT(deck.remarks[0].place, HasSubstr("deck.bdf:11"));
  EXPECT_THAT(deck.remarks[0].text, HasSubstr("FORCE: what it has beyond field 8 of its first line "
                                              "is not read"));
  EXPECT_TRUE(nastran(plate_and_bar + "FORCE,3,2,,100.,0.,0.,1.\nENDDATA\n").remarks.empty());
}

TEST(NastranLoads, WhatIsLeftOutIsSaidAtItsLine) {
  const Deck deck = nastran(with_case("PLOAD4,3,10,.1\n,0,0.,0.,0.,LINE,X\n", 3));
  ASSERT_EQ(deck.remarks.size(), 1U);
  EXPECT_THAT(deck.remarks[0].place, HasSubstr("deck.bdf:15"));
  EXPECT_EQ(deck.remarks[0].text,
            "PLOAD4: a load of set 3 is left out: loads with SORL and LDIR other than SURF and "
            "NORM");
  ASSERT_EQ(deck.load_cases.size(), 1U);
  EXPECT_TRUE(deck.load_cases[0].loads.empty());
  EXPECT_FALSE(entry(deck, "PLOAD4").is_wish);
  // Along the plate's edge the bar is not divided.
  EXPECT_THAT(
      nastran(plate_and_bar + "PLOAD1,2,20,FZ,FR,0.,1.,.5,1.\nENDDATA\n").remarks.at(0).text,
      HasSubstr("PLOAD1: loads begin or end between the grids of bars along edges of plates"));
}

// A misspelt command of case control would leave its case without loads or supports.
TEST(NastranLoads, MisspeltCaseControlIsRefused) {
  const auto said = [](const std::string& line) {
    return complaints_of_nastran("CEND\nSPC = 1\nLOAD = 2\n" + line + "\nBEGIN BULK\n" +
                                 plate_and_bar + "FORCE,2,2,,100.,0.,0.,1.\nENDDATA\n");
  };
  const std::string place = "deck.bdf:4: error: case control: ";
  EXPECT_THAT(said("TMEP(LOAD) = 4"),
              HasSubstr(place + "TMEP is not known here (did you mean TEMP?)"));
  EXPECT_THAT(said("SUBC 1"), HasSubstr(place + "SUBC is not known here (did you mean SUBCASE?)"));
  EXPECT_THAT(said("SUBCAES 1"), HasSubstr("did you mean SUBCASE?"));
  EXPECT_THAT(said("LAOD = 3"), HasSubstr("did you mean LOAD?"));
  EXPECT_THAT(said("SCP = 3"), HasSubstr("did you mean SPC?"));
  EXPECT_THAT(said("MPCC = 3"), HasSubstr("did you mean MPC?"));
  // Commands as they are, by their first letters, and the words of plots.
  for (const std::string line :
       {"SPCF = ALL", "SPCFORCES(PLOT) = ALL", "DISP(PRINT,PUNCH) = ALL", "ESE(PLOT) = ALL",
        "GPFO = ALL", "MPCF = ALL", "OLOA = ALL", "SET 1 = 1 THRU 5,\n7", "LABE = x", "LINE = 99",
        "OUTPUT(XYPLOT)\nSCP 1\nXGRID LINES = YES"})
    EXPECT_THAT(said(line), IsEmpty()) << line;
}

TEST(NastranLoads, UnknownCaseControlIsSaid) {
  const Deck deck = nastran(
      "CEND\nSPC = 1\nSUBT = by four letters\nQQXYZ = 4\nLOADSET = 3\nLOAD = 2\n"
      "BEGIN BULK\n" +
      plate_and_bar + "FORCE,2,2,,100.,0.,0.,1.\nENDDATA\n");
  ASSERT_EQ(deck.remarks.size(), 1U);
  EXPECT_THAT(deck.remarks[0].place, HasSubstr("deck.bdf:4"));
  EXPECT_THAT(deck.remarks[0].text, HasSubstr("case control QQXYZ is not known here"));
  EXPECT_EQ(deck.load_cases.at(0).title, "by four letters");
  EXPECT_FALSE(entry(deck, "case control LOADSET").is_wish);
}

TEST(NastranLoads, LinesThatBearNoLoadAreRefused) {
  const auto said = [](const std::string& cards) {
    return complaints_of_nastran(plate_and_bar + "GRID,5,,0.,4.,0.\nCROD,30,9,4,5\nPROD,9,7,.01\n" +
                                 cards);
  };
  EXPECT_THAT(said("PLOAD1,2,30,FX,FR,0.,1.,1.,1.\n"),
              HasSubstr("deck.bdf:14: error: PLOAD1: a load of set 2 is on element 30, which is no "
                        "CBAR or CBEAM: a rod bears none between its grids"));
  EXPECT_THAT(said("PLOAD1,2,10,FX,FR,0.,1.,1.,1.\n"), HasSubstr("element 10, which is no CBAR"));
  EXPECT_THAT(said("PLOAD1,2,20,QX,FR,0.,1.,1.,1.\n"),
              HasSubstr("the type \"QX\" of a load of set 2 is not known; FX, FY, FZ, MX"));
  EXPECT_THAT(said("PLOAD1,2,20,FX,FRAC,0.,1.,1.,1.\n"),
              HasSubstr("SCALE \"FRAC\" of a load of set 2 is not known; LE, FR, LEPR and FRPR"));
  EXPECT_THAT(said("PLOAD1,2,20,FX,FR,0.,1.,1.5,1.\n"),
              HasSubstr("X2 = 1.5 of a load of set 2 on element 20 is not on it; 0 to 1 is due"));
  EXPECT_THAT(said("PLOAD1,2,20,FX,LE,2.5,1.\n"),
              HasSubstr("X1 = 2.5 of a load of set 2 on element 20 is not on it; 0 to 2 is due"));
  EXPECT_THAT(said("PLOAD1,2,20,FX,FR,.8,1.,.3,1.\n"),
              HasSubstr("X2 = .3 of a load of set 2 lies"));
  EXPECT_THAT(said("PLOAD1,2,20,MX,FRPR,0.,1.,1.,1.\n"),
              HasSubstr("SCALE FRPR of moments (set 2) is not known"));
}

TEST(NastranLoads, ALoadAlongWhatPinFlagsLeaveFreeIsLeftOut) {
  const auto deck_with = [](const std::string& load) {
    return nastran(
        "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCBAR,20,8,1,2,0.,0.,1.\n,1,56\nPBAR,8,7,.01,1.-5,1.-5,"
        "1.-5\nMAT1,7,206.+9,,.3,7850.\n" +
        load + "ENDDATA\n");
  };
  for (const std::string load :
       {"PLOAD1,2,20,FX,FR,0.,1.,1.,1.\n", "PLOAD1,2,20,MY,FR,0.,1.,1.,1.\n"}) {
    const Deck deck = deck_with(load);
    EXPECT_THAT(entry(deck, "PLOAD1").left_out, HasSubstr("a motion that pin flags leave free"));
    ASSERT_EQ(deck.remarks.size(), 1U) << load;
    EXPECT_THAT(deck.remarks[0].place, HasSubstr("deck.bdf:7"));
  }
  EXPECT_TRUE(deck_with("PLOAD1,2,20,FZ,FR,0.,1.,1.,1.\n").remarks.empty());
  // Between its ends the bar has a node, which bears a moment.
  EXPECT_TRUE(deck_with("PLOAD1,2,20,MY,FR,.5,1.\n").remarks.empty());
}

TEST(NastranLoads, ASetOfWrongLoadsIsNotSaidToBeMissing) {
  for (const std::string cards : {"FORCE,3,66,,1.,1.\n", "FORC,3,2,,1.,1.\n", "PLOAD4,3,10,1.O\n",
                                  "PLOAD2,3,7.\n", "LOAD,3,1.O,1.,4\nFORCE,4,2,,1.,1.\n"}) {
    const std::string text = complaints_of_nastran(with_case(cards, 3));
    EXPECT_THAT(text, HasSubstr("deck.bdf:15: error: ")) << cards;
    EXPECT_THAT(text, Not(HasSubstr("load set 3"))) << cards;
  }
  const std::string other = "FORCE,4,2,,1.,1.\nDESVAR,3,T1,1.,.1,5.\n";
  EXPECT_THAT(complaints_of_nastran(with_case(other, 3)),
              HasSubstr("subcase 1: load set 3 does not exist"));
  EXPECT_THAT(complaints_of_nastran(with_case("LOAD,3,1.,1.,5\n", 3)),
              HasSubstr("subcase 1: load set 5 does not exist"));
}

}  // namespace
}  // namespace blocklift::structure::test
