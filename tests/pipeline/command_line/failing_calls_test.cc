// Full disks, short writes, renames that fail, and kills: whatever fails while results are written
// ends with exit code 1 and a message, and the earlier results stay whole.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

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
using test::TemporaryFolder;
using test::text_of_file;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int most_calls = 2000;
constexpr int killed = 137;  // 128 and SIGKILL, as the shell tells it

constexpr auto spring = R"(mechanism: spring
bodies:
  a: {mass: 1 t, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  a: {kind: prismatic, child: a, axis: [0, 0, 1]}
springs:
  s: {kind: joint, joint: a, stiffness: 100 kN/m}
simulate: {duration: 2 s, relative_tolerance: 1e-6, sample_interval: 0.01 s}
outputs:
  a: {joint: a}
)";

struct Fault {
  std::string call;
  std::string how;
};

Outcome run_with(const Fault& fault, int at, const std::string& arguments) {
  return test::run_command(
      "( LD_PRELOAD='" BLOCKLIFT_FAILING_CALLS "' BLOCKLIFT_FAIL_CALL=" + fault.call +
      " BLOCKLIFT_FAIL_AT=" + std::to_string(at) + " BLOCKLIFT_FAIL_HOW=" + fault.how +
      " '" BLOCKLIFT_EXECUTABLE "' " + arguments + " )");
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_directory() ? "folder" : text_of_file(entry.path());
  return files;
}

/// The identity of the run that a summary is of.
std::string run_of_summary() {
  return nlohmann::json::parse(text_of_file("results/summary.json")).at("run").get<std::string>();
}

/// Lets each call fail in turn until a run has fewer of them.
/// @param few calls that are tried one by one; of later ones every tenth part more.
/// @returns how many runs failed.
int fail_in_turn(const Fault& fault, const std::string& arguments, int few) {
  int failures = 0;
  for (int at = 1; at < most_calls; at += std::max(1, (at - few) / 2)) {
    const auto before = contents_of("results");
    const Outcome outcome = run_with(fault, at, arguments);
    if (outcome.exit_code == 0) return failures;
    ++failures;
    EXPECT_EQ(outcome.exit_code, 1) << fault.call << " " << at << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("blocklift: error: ")) << fault.call << " " << at;
    EXPECT_TRUE(contents_of("results") == before) << fault.call << " " << at << ", " << fault.how;
  }
  ADD_FAILURE() << "runs never come to an end";
  return failures;
}

TEST(FailingCalls, OfASimulationLeaveEarlierResultsWhole) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", spring);
  const std::string arguments = "simulate mechanism.yaml --csv -o results";
  ASSERT_EQ(test::run_blocklift(arguments).exit_code, 0);
  EXPECT_GE(fail_in_turn({"open", "error"}, arguments, 20), 4);
  EXPECT_GE(fail_in_turn({"write", "error"}, arguments, 8), 8);
  EXPECT_GE(fail_in_turn({"write", "full"}, arguments, 8), 8);
  EXPECT_GE(fail_in_turn({"fsync", "error"}, arguments, 20), 4);
  EXPECT_GE(fail_in_turn({"rename", "error"}, arguments, 30), 8);
}

// The same writers as above, and pictures of the block: some calls of each kind are enough.
TEST(FailingCalls, OfAnAssessmentLeaveEarlierResultsWhole) {
  const TemporaryFolder folder;
  const std::string arguments = "assess '" BLOCKLIFT_SMALL_LIFT "' -o results";
  ASSERT_EQ(test::run_blocklift(arguments).exit_code, 0);
  const auto before = contents_of("results");
  const std::pair<Fault, int> faults[] = {{{"rename", "error"}, 12},
                                          {{"rename", "error"}, 15},
                                          {{"write", "full"}, 60},
                                          {{"write", "error"}, 2},
                                          {{"open", "error"}, 3}};
  for (const auto& [fault, at] : faults) {
    const Outcome outcome = run_with(fault, at, arguments);
    EXPECT_EQ(outcome.exit_code, 1) << fault.call << " " << at << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("blocklift: error: ")) << fault.call << " " << at;
    EXPECT_TRUE(contents_of("results") == before) << fault.call << " " << at;
  }
}

constexpr auto bar = R"(part: bar
mesh: {file: bar.geo, length_unit: mm}
materials:
  steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, yield_stress: 235 MPa}
supports:
  root: {groups: [root]}
loads:
  pull: {groups: [end], force: [600 kN, 0 kN, 0 kN]}
)";

constexpr auto coarse_bar_geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {2000, 0, 0}; Point(3) = {2000, 300, 0}; Point(4) = {0, 300, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Mesh.MeshSizeMax = 400;
out[] = Extrude{0, 0, 200}{ Surface{1}; };
Physical Volume("bar") = {out[1]};
Physical Surface("root") = {out[5]};
Physical Surface("end") = {out[3]};
)";

TEST(FailingCalls, OfAPartsStressLeaveEarlierResultsWhole) {
  const TemporaryFolder folder;
  folder.write("bar.yaml", bar);
  folder.write("bar.geo", coarse_bar_geometry);
  const std::string arguments = "stress bar.yaml -o results";
  const Outcome whole = test::run_blocklift(arguments);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_GE(fail_in_turn({"open", "error"}, arguments, 4), 2);
  EXPECT_GE(fail_in_turn({"write", "full"}, arguments, 4), 4);
  EXPECT_GE(fail_in_turn({"fsync", "error"}, arguments, 4), 2);
  EXPECT_GE(fail_in_turn({"rename", "error"}, arguments, 6), 4);
}

TEST(FailingCalls, OfAStudyLeaveEarlierResultsWhole) {
  const TemporaryFolder folder;
  fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
  folder.write("study.yaml",
               "study: spread\ncase: lift\nmembers: 3\nvary:\n  weight: {keys: ['block:mass'], "
               "spread: {law: normal, mean: 8 t, deviation: 0.2 t}}\n");
  const std::string arguments = "sweep study.yaml -o results";
  const Outcome whole = test::run_blocklift(arguments);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // The members are done; the study's own files are written again.
  for (const auto& [fault, at] : {std::pair<Fault, int>{{"write", "error"}, 1},
                                  {{"write", "full"}, 5},
                                  {{"fsync", "error"}, 2},
                                  {{"rename", "error"}, 2},
                                  {{"rename", "error"}, 7}}) {
    const auto before = contents_of("results");
    const Outcome outcome = run_with(fault, at, arguments);
    EXPECT_EQ(outcome.exit_code, 1) << fault.call << " " << at << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("blocklift: error: ")) << fault.call << " " << at;
    EXPECT_TRUE(contents_of("results") == before) << fault.call << " " << at;
  }
}

TEST(FailingCalls, OfTheWorstMembersReportAreNoSuccess) {
  const TemporaryFolder folder;
  fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
  folder.write("study.yaml",
               "study: spread\ncase: lift\nmembers: 2\nvary:\n  weight: {keys: ['block:mass'], "
               "spread: {law: normal, mean: 8 t, deviation: 0.2 t}}\n");
  const std::string arguments = "sweep study.yaml -o results";
  const Outcome whole = test::run_blocklift(arguments);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // The members are done. The process that writes the report alone has so many calls.
  const auto before = contents_of("results/worst");
  const Outcome outcome = run_with({"write", "error"}, 60, arguments);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the report of member "));
  EXPECT_TRUE(contents_of("results/worst") == before);
}

std::string pontoon_with(int frequencies) {
  return "kind: vessel\nhull: {barge: {length: 12 m, breadth: 8 m, depth: 4 m}}\n"
         "panel_size: 1 m\nmass: 150 t\ncentre_of_mass: [0 m, 0 m, 2 m]\n"
         "radii_of_gyration: [3 m, 4 m, 4 m]\n"
         "hydrodynamics: {frequencies: {lowest: 1.5 rad/s, highest: 3 rad/s, count: " +
         std::to_string(frequencies) + "}, headings: [0 deg]}\n";
}

TEST(FailingCalls, OfADatabaseLeaveTheEarlierOneAndItsPage) {
  const TemporaryFolder folder;
  // Without the cache, of which nothing is needed: what cannot be put there is no failure.
  const std::string arguments = "hydro pontoon --no-cache -o results/pontoon.h5";
  folder.write("pontoon/vessel.yaml", pontoon_with(4));
  const Outcome whole = test::run_blocklift(arguments);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const auto before = contents_of("results");
  folder.write("pontoon/vessel.yaml", pontoon_with(5));
  for (const auto& [fault, at] : {std::pair<Fault, int>{{"write", "error"}, 1},
                                  {{"write", "full"}, 4},
                                  {{"write", "error"}, 9},
                                  {{"fsync", "error"}, 1},
                                  {{"rename", "error"}, 1}}) {
    const Outcome outcome = run_with(fault, at, arguments);
    EXPECT_EQ(outcome.exit_code, 1) << fault.call << " " << at << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("blocklift: error: ")) << fault.call << " " << at;
    EXPECT_TRUE(contents_of("results") == before) << fault.call << " " << at;
  }
  // Between the database and its page: the next run sees that the page is another's.
  const std::string page = text_of_file("results/pontoon.html");
  EXPECT_EQ(run_with({"rename", "kill"}, 2, arguments).exit_code, killed);
  EXPECT_EQ(text_of_file("results/pontoon.html"), page);
  const Outcome again = test::run_blocklift("hydro pontoon -o results/pontoon.h5");
  EXPECT_THAT(again.out, HasSubstr("already computed"));
  EXPECT_NE(text_of_file("results/pontoon.html"), page);
}

/// Lets a demand for much memory fail, here and there, once or from there on.
/// @returns how many runs failed.
int run_short_of_memory(const std::string& arguments) {
  int failures = 0;
  for (const char* how : {"error", "full"}) {
    for (int at = 1; at < 5000; at *= 8) {
      const auto before = contents_of("results");
      const Outcome outcome = run_with({"memory", how}, at, arguments);
      // Some demands are not vital: the run ends well, and its results are whole.
      if (outcome.exit_code == 0) continue;
      ++failures;
      // Gmsh reads in a process of its own, whose death is taken for the file's fault. OpenBLAS
      // ends the program itself, with a word.
      const bool in_gmsh = outcome.err.find("Gmsh crashed") != std::string::npos;
      EXPECT_EQ(outcome.exit_code, in_gmsh ? 2 : 1) << how << " " << at << ": " << outcome.err;
      EXPECT_THAT(outcome.err, AnyOf(HasSubstr("error: "), HasSubstr("OpenBLAS: malloc failed")))
          << how << " " << at;
      EXPECT_TRUE(contents_of("results") == before) << how << " " << at;
    }
  }
  return failures;
}

TEST(FailingCalls, OfMemoryEndAnAssessment) {
  const TemporaryFolder folder;
  const std::string arguments = "assess '" BLOCKLIFT_SMALL_LIFT "' -o results";
  ASSERT_EQ(test::run_blocklift(arguments).exit_code, 0);
  EXPECT_GE(run_short_of_memory(arguments), 3);
}

/// A folder with a verdict holds the files of one run; without one `report` completes the move.
void expect_one_run(int at) {
  if (fs::exists("results/summary.json") && fs::exists("results/report.html")) {
    EXPECT_THAT(text_of_file("results/report.html"), HasSubstr(run_of_summary())) << at;
  }
  const Outcome report = test::run_blocklift("report results");
  EXPECT_EQ(report.exit_code, 0) << at << ": " << report.err;
  EXPECT_FALSE(fs::exists("results/.in-preparation/moves.txt")) << at;
  EXPECT_THAT(text_of_file("results/report.html"), HasSubstr(run_of_summary())) << at;
}

TEST(Kills, BetweenAnyTwoRenamesLeaveNoMixture) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", spring);
  ASSERT_EQ(test::run_blocklift("simulate mechanism.yaml --csv -o results").exit_code, 0);
  int kills = 0;
  for (int at = 1; at < most_calls; ++at, ++kills) {
    const Outcome outcome =
        run_with({"rename", "kill"}, at, "simulate mechanism.yaml --csv -o results");
    if (outcome.exit_code == 0) break;
    ASSERT_EQ(outcome.exit_code, killed) << outcome.err;
    expect_one_run(at);
  }
  EXPECT_GE(kills, 8);
}

TEST(Kills, AtAnyInstantLeaveNoMixture) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", spring);
  const std::string command = "'" BLOCKLIFT_EXECUTABLE "' simulate mechanism.yaml -o results";
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(test::run_command(command).exit_code, 0);
  const double usual =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  constexpr int kills = 20;
  for (int i = 0; i < kills; ++i) {
    const double seconds = usual * (0.2 + 0.9 * i / kills);
    test::run_command("( timeout -s KILL " + std::to_string(seconds) + " " + command + " )");
    expect_one_run(i);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
