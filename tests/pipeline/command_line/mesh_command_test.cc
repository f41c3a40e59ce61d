// A block read from a deck, as a user meets it.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::TemporaryFolder;
using test::text_of_file;
using test::with;
using ::testing::HasSubstr;

/// The case with its crane and deck in a folder of their own.
class MeshCommand : public ::testing::Test {
 protected:
  MeshCommand() {
    fs::copy(fs::path(BLOCKLIFT_TEST_CASES) / "mesh-lift", "mesh-lift",
             fs::copy_options::recursive);
  }
  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }
  void change(const std::string& file, const std::string& old_passage,
              const std::string& new_passage) const {
    const fs::path path = fs::path("mesh-lift") / file;
    folder_.write(path, with(text_of_file(path), old_passage, new_passage));
  }

  const TemporaryFolder folder_;
};

TEST_F(MeshCommand, LiftsADeckAndNamesWhatItLeavesOut) {
  const Outcome outcome = run("assess mesh-lift -o out");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(test::only_progress));
  EXPECT_THAT(outcome.out, HasSubstr("deck box.bdf: 199 nodes, 185 shells, 32 beams, 1 masses"));
  EXPECT_THAT(outcome.out, HasSubstr("FORCE: 0 of 1 used; left out: loads and supports"));
  EXPECT_TRUE(fs::exists("out/report.html"));
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  EXPECT_NEAR(summary["structure"]["mass"]["total_kg"].get<double>(), 8000, 1e-3);
  EXPECT_EQ(summary["mesh_page"], "mesh.html");
  EXPECT_TRUE(fs::exists("out/mesh.html"));
  EXPECT_THAT(text_of_file("out/report.html"), HasSubstr("<a href=\"mesh.html\">"));
}

TEST_F(MeshCommand, ValidateShowsTheDeck) {
  for (const char* file : {"mesh-lift/block.yaml", "mesh-lift/case.yaml"}) {
    const Outcome outcome = run(std::string("validate ") + file);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("PLOTEL: 0 of 1 used"));
  }
}

TEST_F(MeshCommand, PicturesOfABlockStandInTheFolderThatIsNamed) {
  const Outcome outcome = run("validate mesh-lift/block.yaml --pictures pictures");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("pictures: pictures/mesh-lift.html"));
  const std::string page = text_of_file("pictures/mesh-lift.html");
  EXPECT_THAT(page, HasSubstr("Open box from a deck"));
  EXPECT_THAT(page, HasSubstr("</html>"));
}

TEST_F(MeshCommand, NoPicturesOfADeckThatIsWrong) {
  change("box.bdf", "CQUAD4,1,1,1,2,3,4", "CQUAD4,1,1,1,7777,3,4");
  EXPECT_EQ(run("validate mesh-lift/block.yaml --pictures pictures").exit_code, 2);
  EXPECT_FALSE(fs::exists("pictures"));
}

TEST_F(MeshCommand, FilesWithoutElementsAreRefused) {
  folder_.write("nodes.bdf", "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n");
  folder_.write("empty.msh", "");
  for (const char* file : {"nodes.bdf, units: m-kg-N", "empty.msh, units: m"}) {
    folder_.write("nothing.yaml",
                  std::string("kind: block\nmesh: {file: ") + file + ", yield_stress: 235 MPa}\n");
    const Outcome outcome = run("validate nothing.yaml");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, ::testing::AnyOf(HasSubstr("nodes.bdf has no plates, bars or solids"),
                                              HasSubstr("neither plates nor bars")));
  }
}

TEST_F(MeshCommand, EquationsThatHoldTheWholeAreNoneOfALift) {
  change("box.bdf", "SUBCASE 1", "MPC = 7\nSUBCASE 1");
  change("box.bdf", "ENDDATA", "MPC,7,2,3,1.,2,1,-.5\nENDDATA");
  const Outcome outcome = run("validate mesh-lift/block.yaml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("box.bdf:475: error: an equation resists motions of the block"));
}

TEST_F(MeshCommand, GoverningLoadCasesAreDecksThatAreReadAgain) {
  const Outcome outcome = run("assess mesh-lift -o out --decks");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  for (const char* name : {"load-cases.inp", "load-cases.bdf", "load-cases.csv"})
    EXPECT_TRUE(fs::exists(fs::path("out") / name)) << name;
  // The same shells come back: the deck takes the place of the block's own.
  fs::copy("out/load-cases.bdf", "mesh-lift/load-cases.bdf");
  change("block.yaml", "file: box.bdf", "file: load-cases.bdf");
  const Outcome again = run("validate mesh-lift/block.yaml");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("185 shells, 32 beams"));
}

/// A frame of twelve box bars with a lug at each upper corner.
std::string deck_of_bars() {
  std::string deck = "BEGIN BULK\n";
  int node = 0, bar = 0;
  for (const char* z : {"700.", "2200."})
    for (const char* y : {"0.", "3000."})
      for (const char* x : {"750.", "3250."})
        deck += "GRID," + std::to_string(++node) + ",," + x + "," + y + "," + z + "\n";
  const auto add = [&](int from, int to, const char* direction) {
    deck += "CBAR," + std::to_string(++bar) + ",1," + std::to_string(from) + "," +
            std::to_string(to) + "," + direction + "\n";
  };
  for (const int low : {1, 5}) {
    add(low, low + 1, "0.,0.,1.");
    add(low + 2, low + 3, "0.,0.,1.");
    add(low, low + 2, "0.,0.,1.");
    add(low + 1, low + 3, "0.,0.,1.");
  }
  for (const int low : {1, 2, 3, 4}) add(low, low + 4, "1.,0.,0.");
  return deck + "PBARL,1,1,,BOX\n+,300.,300.,20.,20.\nMAT1,1,206000.,,.3,7.85-9\nENDDATA\n";
}

TEST_F(MeshCommand, LiftsAFrameOfBarsAlone) {
  folder_.write("mesh-lift/frame.bdf", deck_of_bars());
  folder_.write("mesh-lift/block.yaml",
                "kind: block\nmesh: {file: frame.bdf, units: mm-t-N, yield_stress: 355 MPa}\n"
                "lugs: {L1: {node: 5}, L2: {node: 6}, L3: {node: 7}, L4: {node: 8}}\n");
  const Outcome outcome = run("assess mesh-lift -o out --decks");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the block is of bars alone"));
  const auto summary = nlohmann::json::parse(text_of_file("out/summary.json"));
  const auto& structure = summary["structure"];
  EXPECT_EQ(structure["estimated_error"]["worst_part"], "");
  // 28 m of bars less what their corners have in common is not taken off: 0.0224 m^2 of steel.
  EXPECT_NEAR(structure["mass"]["total_kg"].get<double>(), 28 * 0.0224 * 7850, 1e-3);
  const auto checks = summary["checks"];
  EXPECT_TRUE(std::any_of(checks.begin(), checks.end(), [](const auto& check) {
    return check["name"].template get<std::string>().starts_with("stress in ");
  }));
  for (const char* name : {"load-cases.inp", "load-cases.bdf"})
    EXPECT_TRUE(fs::exists(fs::path("out") / name)) << name;
}

TEST_F(MeshCommand, DecksAreWrittenOnRequestAlone) {
  const Outcome outcome = run("assess mesh-lift -o out");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  for (const char* name : {"load-cases.inp", "load-cases.bdf", "load-cases.csv"})
    EXPECT_FALSE(fs::exists(fs::path("out") / name)) << name;
}

TEST_F(MeshCommand, ABadDeckIsWrongInputAndNothingIsWritten) {
  change("box.bdf", "CQUAD4,1,1,1,2,3,4", "CQUAD4,1,1,1,7777,3,4");
  const Outcome outcome = run("assess mesh-lift -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("mesh-lift/box.bdf:"));
  EXPECT_THAT(outcome.err, HasSubstr("error: CQUAD4: CQUAD4 1 names grid 7777"));
  EXPECT_FALSE(fs::exists("out"));
}

/// What is done to the deck or the block's file, and what is said of it.
struct Spoiled {
  std::string file, old_passage, new_passage;
  std::string place, complaint;
};

TEST_F(MeshCommand, BadDecksAreRefusedWithTheirLine) {
  const std::vector<Spoiled> all{
      {"box.bdf", "CQUAD4,1,1,1,2,3,4", "CQUAD4,1,77,1,2,3,4", "box.bdf:209",
       "error: CQUAD4: property 77 does not exist"},
      {"box.bdf", "ENDDATA", "CBEND,9100,1,1,2,0.,0.,1.,1\nENDDATA", "box.bdf:474",
       "error: CBEND: curved bars are not known"},
      {"box.bdf", "ENDDATA", "WEIRD,1,2\nENDDATA", "box.bdf:474",
       "error: the card WEIRD is not known here"},
      {"box.bdf", "ENDDATA", "CONROD,9100,1,9100,7,100.\nGRID,9100,,9.+3,0.,0.\nENDDATA",
       "block.yaml:3", "1 vertices can move in a direction that nothing there resists: 9100"},
      {"box.bdf", "ENDDATA\n", "GRID,9101,,9.+3,", "box.bdf:474", "error: the deck is cut off"},
      {"box.bdf", "ENDDATA", "CONM2,9102,1,,8.6+5\nENDDATA", "block.yaml:3",
       "the block weighs 8.6e+05 t if units are mm-t-N"},
      {"block.yaml", "mm-t-N", "m-kg-N", "box.bdf:469", "Is the deck in other units?"},
      {"block.yaml", "yield_stress: 355 MPa", "yield_stress: 355 MPa, thicknesses: {a: 3 mm}",
       "block.yaml:3", "box.bdf has no group \"a\" without a thickness"}};
  for (const Spoiled& one : all) {
    const fs::path path = fs::path("mesh-lift") / one.file;
    const std::string before = text_of_file(path);
    change(one.file, one.old_passage, one.new_passage);
    const Outcome outcome = run("validate mesh-lift/block.yaml");
    EXPECT_EQ(outcome.exit_code, 2) << one.complaint;
    EXPECT_THAT(outcome.err, HasSubstr(one.complaint));
    EXPECT_THAT(outcome.err, HasSubstr("mesh-lift/" + one.place + ":"));
    folder_.write(path, before);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
