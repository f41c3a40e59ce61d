// `blocklift stress` on the load cases of a block's deck, as a user meets it: run as a process.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Outcome stress(const std::string& arguments) { return test::run_blocklift("stress " + arguments); }

const char* const strip_block = R"(
kind: block
title: Strip
mesh: {file: strip.bdf, units: mm-t-N, yield_stress: 235 MPa}
)";

// A strip of 1 x 1 m and 10 mm, pulled by 2 kN, or pressed across.
const char* const strip_deck = R"(SOL 101
CEND
SUBCASE 1
  SUBTITLE = pull
  SPC = 1
  LOAD = 2
SUBCASE 7
  SPC = 1
  LOAD = 3
SUBCASE 8
  LOAD = 3
BEGIN BULK
GRID,11,,0.,0.,0.
GRID,12,,1000.,0.,0.
GRID,13,,1000.,1000.,0.
GRID,14,,0.,1000.,0.
CQUAD4,1,1,11,12,13,14
PSHELL,1,1,10.,1,,1
MAT1,1,206000.,,0.,7.85-9
SPC1,1,123456,11,14
FORCE,2,12,,1000.,1.,0.,0.
FORCE,2,13,,1000.,1.,0.,0.
PLOAD4,3,1,-0.01
ENDDATA
)";

class StressOfDeck : public ::testing::Test {
 protected:
  StressOfDeck() {
    folder_.write("strip.bdf", strip_deck);
    folder_.write("strip.yaml", strip_block);
  }
  void change(const std::string& old_passage, const std::string& new_passage) const {
    std::string text = strip_deck;
    text.replace(text.find(old_passage), old_passage.size(), new_passage);
    folder_.write("strip.bdf", text);
  }
  test::TemporaryFolder folder_;
};

// A force at the middle of a curved edge is beside elements of degree 1, which are straight.
TEST_F(StressOfDeck, DegreeOneIsRefusedWhereALoadIsOffIt) {
  change("CQUAD4,1,1,11,12,13,14",
         "GRID,15,,500.,0.,50.\nCQUAD8,1,1,11,12,13,14,15\nFORCE,2,15,,1000.,1.,0.,0.");
  const Outcome outcome = stress("strip.yaml -o out --degree 1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("1 nodes that are loaded, held or joined, 15 the first"));
  EXPECT_EQ(stress("strip.yaml -o out").exit_code, 0);
}

// As validate and assess do.
TEST_F(StressOfDeck, WarnsOfPlatesThatLieOnOneAnother) {
  change("PSHELL,1,", "CQUAD4,2,1,14,13,12,11\nPSHELL,1,");
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const char* const sentence = "1 shells have the corners of another: 2";
  EXPECT_THAT(outcome.out, HasSubstr(std::string("warning: ") + sentence));
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  EXPECT_EQ(summary["warnings"], nlohmann::json({sentence}));
}

TEST_F(StressOfDeck, SolvesEachCase) {
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("pull"), HasSubstr("case 8 is not solved: nothing "
                                                              "holds it")));
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  ASSERT_EQ(summary["cases"].size(), 2U);
  const auto& pull = summary["cases"][0];
  EXPECT_EQ(pull["label"], 1);
  EXPECT_NEAR(pull["reactions"]["force_N"][0].get<double>(), -2000, 1e-6);
  EXPECT_NEAR(pull["checked_von_mises"]["value_Pa"].get<double>(), 2000 / 0.01, 0.05 * 2e5);
  EXPECT_NEAR(summary["cases"][1]["applied"]["force_N"][2].get<double>(), -10000, 1e-6);
  EXPECT_EQ(summary["skipped"][0]["label"], 8);
  EXPECT_THAT(text_of_file("out/reactions.csv"), AllOf(HasSubstr("\n1,11,"), HasSubstr("\n7,14,")));
  EXPECT_THAT(text_of_file("out/nodes.csv"), HasSubstr("\n1,12,1,0,0,"));
  EXPECT_TRUE(fs::exists("out/case-1.vtu"));
  EXPECT_TRUE(fs::exists("out/case-7.vtu"));
}

TEST_F(StressOfDeck, PicturesOfEarlierCasesGo) {
  EXPECT_EQ(stress("strip.yaml -o out").exit_code, 0);
  change("SUBCASE 7", "SUBCASE 5");
  EXPECT_EQ(stress("strip.yaml -o out --degree 2").exit_code, 0);
  EXPECT_FALSE(fs::exists("out/case-7.vtu"));
  EXPECT_TRUE(fs::exists("out/case-5.vtu"));
  EXPECT_EQ(nlohmann::json::parse(text_of_file("out/summary.json"))["element_degree"], 2);
}

TEST_F(StressOfDeck, SpringsToTheGroundHold) {
  change("SPC1,1,123456,11,14\n", "SPC1,1,23456,11,14\nCELAS2,9,500.,11,1\nCELAS2,10,500.,14,1\n");
  EXPECT_EQ(stress("strip.yaml -o out").exit_code, 0);
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  // 2 kN over two springs of 500 N/mm: 2 mm, beside 0.001 mm of the strip.
  EXPECT_NEAR(summary["cases"][0]["max_displacement"]["value_m"].get<double>(), 0.002, 1e-5);
}

// What the deck has and its cases lack is a warning beside their figures.
TEST_F(StressOfDeck, LoadsThatAreLeftOutAreSaid) {
  change("PLOAD4,3,1,-0.01\n", "PLOAD4,3,1,-0.01\nACCEL,3,,0.,0.,1.,Z,10.\n");
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("warning: these cases lack what the deck has: ACCEL: 0 of 1"));
  EXPECT_THAT(text_of_file("out/summary.json"), HasSubstr("ACCEL: 0 of 1 used"));
}

// About a line beside its grids a beam without torsional stiffness turns, and they swing with it.
TEST_F(StressOfDeck, BeamsWithoutTorsionAreNamedWhereOneSwings) {
  folder_.write("strip.bdf",
                "SOL 101\nCEND\nSPC=1\nLOAD=1\nBEGIN BULK\n"
                "GRID,1,,0.,0.,0.\nGRID,2,,1000.,0.,0.\n"
                "CBEAM,7,1,1,2,0.,1.,0.\n,,,0.,50.,0.,0.,50.,0.\n"
                "PBEAM,1,1,600.,45000.,20000.\nMAT1,1,206000.,,.3,7.85-9\n"
                "SPC1,1,123456,1\nFORCE,1,2,,1000.,0.,0.,1.\nENDDATA\n");
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("1 beam has no torsional stiffness, J of PBEAM 1, element 7 "
                                     "the first: is it left out?"));
}

TEST_F(StressOfDeck, WhatSupportsLeaveFreeIsTold) {
  change("SPC1,1,123456,11,14", "SPC1,1,3456,11,14");
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("strip.yaml:4:"), HasSubstr("the supports of case 1 (pull) "
                                                          "leave a part free to move")));
  EXPECT_FALSE(fs::exists("out"));
}

TEST_F(StressOfDeck, DecksWithoutCasesAreRefused) {
  change("SPC = 1\n  LOAD = 2", "SPC = 1");
  change("SUBCASE 7\n  SPC = 1\n", "SUBCASE 7\n");
  std::string text = strip_deck;
  text.replace(text.find("SUBCASE 1"), text.find("BEGIN BULK") - text.find("SUBCASE 1"), "");
  folder_.write("strip.bdf", text);
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("has no load case of its own that could be solved"));
}

// Where all loads of a deck are of a kind that is left out, it is said where they stand.
TEST_F(StressOfDeck, LoadsThatAreAllLeftOutAreNamed) {
  std::string text = strip_deck;
  text.replace(text.find("SUBCASE 1"), text.find("BEGIN BULK") - text.find("SUBCASE 1"),
               "SUBCASE 1\n  SPC = 1\n  LOAD = 30\n");
  text.insert(text.find("SPC1,1,123456,11,14"), "ACCEL,30,,0.,0.,1.,Z,10.\n");
  folder_.write("strip.bdf", text);
  const long line =
      std::count(text.begin(), text.begin() + static_cast<long>(text.find("ACCEL")), '\n') + 1;
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("no load acts in case 1"),
                                 HasSubstr("strip.bdf:" + std::to_string(line) +
                                           ": ACCEL: 0 of 1 "
                                           "used; left out: ")));
}

// What comes behind a title that ends in a comma does not go on with it.
TEST_F(StressOfDeck, TitlesEndWithTheirLine) {
  change("SUBCASE 1\n  SUBTITLE = pull\n", "SUBCASE 1\n  SUBTITLE = pull, port,\n");
  EXPECT_EQ(stress("strip.yaml -o out").exit_code, 0);
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  ASSERT_EQ(summary["cases"].size(), 2U);
  EXPECT_EQ(summary["cases"][0]["label"], 1);
}

// PS of GRID holds as SPC1 does, and nothing says that the case lacks it.
TEST_F(StressOfDeck, ConstraintsOfGridsHold) {
  const std::string node = "GRID,11,,0.,0.,0.", both = "SPC1,1,123456,11,14";
  std::string text = strip_deck;
  text.replace(text.find(node), node.size(), node + ",,123456");
  text.replace(text.find(both), both.size(), "SPC1,1,123456,14");
  folder_.write("strip.bdf", text);
  const Outcome outcome = stress("strip.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("lack")));
  EXPECT_THAT(text_of_file("out/reactions.csv"), HasSubstr("\n1,11,"));
}

TEST_F(StressOfDeck, OptionsOfPartsAreRefused) {
  const Outcome outcome = stress("strip.yaml --calculix");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--calculix is for parts"));
}

}  // namespace
}  // namespace blocklift::pipeline
