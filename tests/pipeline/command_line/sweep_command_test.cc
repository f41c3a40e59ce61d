// `blocklift sweep` as a user meets it: run as a process.

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/sling_over_edge_lift.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::HasSubstr;

/// The small lift and a study of it in a folder of their own.
class SweepCommand : public ::testing::Test {
 protected:
  SweepCommand() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    write_study(weight);
  }
  void write_study(const std::string& lines) const {
    folder_.write("study.yaml", "study: spread\ncase: lift\n" + lines);
  }
  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }
  static nlohmann::json figure(const std::string& folder, const std::string& name) {
    const auto study = nlohmann::json::parse(text_of_file(folder + "/study.json"));
    for (const auto& one : study["figures"])
      if (one["name"] == name) return one;
    return nullptr;
  }

  static constexpr const char* weight =
      "members: 24\n"
      "vary:\n"
      "  weight: {keys: ['block:mass'], spread: {law: normal, mean: 8 t, deviation: 0.2 t}}\n";
  static constexpr const char* checked = "structure.history.dynamic.checked_von_mises_Pa";
  const test::TemporaryFolder folder_;
};

// Tensions at rest are the weight's, so that they spread as it does.
TEST_F(SweepCommand, LoadsAtRestSpreadAsTheWeight) {
  const Outcome outcome = run("sweep study.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(test::only_progress));
  EXPECT_THAT(outcome.out, HasSubstr("24 members, 0 failed\n"));
  const auto tension = figure("out", "ropes.R1.max_static_tension_N");
  const double share = tension["deviation"].get<double>() / tension["mean"].get<double>();
  EXPECT_NEAR(share, 0.2 / 8, 0.1 * 0.2 / 8);  // of 24 members
  EXPECT_NEAR(tension["rank_correlation"]["weight"].get<double>(), 1, 1e-12);
  for (const char* file : {"study.csv", "study.h5", "study.html", "worst/report.html"})
    EXPECT_TRUE(fs::is_regular_file(fs::path("out") / file)) << file;
  const std::string page = text_of_file("out/study.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("24 lifts of the case lift"));
  // Two tables show it, both in kN: some 20 kN are the weight's at each of four slings.
  const auto rows = std::regex("ropes, R1, max static tension, kN</td><td>1?[0-9]{2}\\.");
  EXPECT_EQ(
      std::distance(std::sregex_iterator(page.begin(), page.end(), rows), std::sregex_iterator()),
      2);
}

// The first 31 values of Sobol's sequence stand at even steps of a 32nd: of 0.8 t their deviation is
// 25 kg sqrt(31 * 32 / 12). The crane's load at rest is the weight of 8 t and of two hooks of 0.3 t.
// The mean stood within 2e-5 of that, the deviation within 7e-6.
TEST_F(SweepCommand, TheVarianceOfALinearLiftIsKnownByHand) {
  write_study(
      "design: low discrepancy\nmembers: 31\nvary:\n"
      "  weight: {keys: ['block:mass'], spread: {law: uniform, lowest: 7.6 t, highest: 8.4 t}}\n");
  ASSERT_EQ(run("sweep study.yaml -o out -q").exit_code, 0);
  const auto load = figure("out", "cranes.C1.max_static_load_N");
  constexpr double gravity = 9.81;
  const double mean = gravity * 8600, deviation = gravity * 25 * std::sqrt(31 * 32 / 12.0);
  EXPECT_NEAR(load["mean"].get<double>(), mean, 1e-4 * mean);
  EXPECT_NEAR(load["deviation"].get<double>(), deviation, 1e-4 * deviation);
}

// At rest the crane carries 9.81 N of each kg of block and hook blocks: 90 % of 0.8 t of the block
// are 7063.2 N, 90 % of 100 kg of a hook block 882.9 N. They stood within 0.05 N.
TEST_F(SweepCommand, SwingsOfALinearLiftAreKnownByHand) {
  write_study(
      "members: 12\nvary:\n"
      "  hook: {keys: ['gantry:hoists.left.hook_block.mass'], spread: {law: uniform, lowest: 250 "
      "kg, "
      "highest: 350 kg}}\n"
      "  weight: {keys: ['block:mass'], spread: {law: uniform, lowest: 7.6 t, highest: 8.4 t}}\n"
      "figures: [cranes.C1.max_static_load_N]\n");
  const Outcome outcome = run("sweep study.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto load = figure("out", "cranes.C1.max_static_load_N");
  EXPECT_NEAR(load["swings"]["weight"]["swing"].get<double>(), 9.81 * 720, 0.2);
  EXPECT_NEAR(load["swings"]["hook"]["swing"].get<double>(), 9.81 * 90, 0.2);
  EXPECT_NEAR(load["linear_share"].get<double>(), 1, 1e-9);
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("weight +7640 kg +8360 kg +\\+7\\.06\n"
                                                    ".*hook +255 kg +345 kg +\\+0\\.883\n"));
  EXPECT_THAT(text_of_file("out/study.html"), HasSubstr("<td>weight</td><td>7640 kg</td>"));
}

TEST_F(SweepCommand, GivesTheSameWithAnyNumberOfWorkersAndAfterAKill) {
  ASSERT_EQ(run("sweep study.yaml -o one --workers 1 -q").exit_code, 0);
  ASSERT_EQ(run("sweep study.yaml -o three --workers 3 -q").exit_code, 0);
  EXPECT_EQ(text_of_file("one/study.csv"), text_of_file("three/study.csv"));
  EXPECT_EQ(text_of_file("one/study.json"), text_of_file("three/study.json"));
  EXPECT_EQ(text_of_file("one/study.h5"), text_of_file("three/study.h5"));

  // What a killed study leaves: some members.
  fs::create_directories("killed/members");
  for (const char* file : {"identity", "000000.json", "000007.json", "000023.json"})
    fs::copy_file(fs::path("one/members") / file, fs::path("killed/members") / file);
  ASSERT_EQ(run("sweep study.yaml -o killed -q").exit_code, 0);
  EXPECT_EQ(text_of_file("one/study.csv"), text_of_file("killed/study.csv"));
}

// A part that was lost is computed by the machine that joins the others.
TEST_F(SweepCommand, IsSplitOverMachinesAndJoined) {
  ASSERT_EQ(run("sweep study.yaml -o whole -q").exit_code, 0);
  const Outcome first = run("sweep study.yaml --part 1/3 -o first --workers 2");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("part 1/3: its 8 of 24 members"));
  EXPECT_FALSE(fs::exists("first/study.json"));
  EXPECT_TRUE(fs::exists("first/members/000003.json"));
  EXPECT_FALSE(fs::exists("first/members/000004.json"));
  ASSERT_EQ(run("sweep study.yaml --part 3/3 -o third -q").exit_code, 0);
  const Outcome joined = run("sweep study.yaml --join first --join third -o joined");
  ASSERT_EQ(joined.exit_code, 0) << joined.err;
  EXPECT_THAT(joined.out, HasSubstr("third: 8 members taken over\n"));
  EXPECT_EQ(text_of_file("joined/study.csv"), text_of_file("whole/study.csv"));
  EXPECT_EQ(text_of_file("joined/study.json"), text_of_file("whole/study.json"));
}

TEST_F(SweepCommand, RefusesPartsThatDoNotFit) {
  for (const char* part : {"0/3", "4/3", "1.5/3", "3", "a/b", "1/0"}) {
    const Outcome outcome = run(std::string("sweep study.yaml -o out --part ") + part);
    EXPECT_EQ(outcome.exit_code, 2) << part;
    EXPECT_THAT(outcome.err, HasSubstr("for example 3/10")) << part;
  }
  ASSERT_EQ(run("sweep study.yaml --part 1/12 -o part -q").exit_code, 0);
  write_study(std::string(weight) + "seed: 5\n");
  const Outcome other = run("sweep study.yaml --join part -o out");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("part: error: the folder holds members of another study"));
  const Outcome none = run("sweep study.yaml --join lift -o out");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("lift: error: the folder holds no members of a study"));
}

TEST_F(SweepCommand, GoesOnAfterKillsInTheMiddle) {
  ASSERT_EQ(run("sweep study.yaml -o whole -q").exit_code, 0);
  for (int kill = 0; kill < 3; ++kill)
    test::run_command("timeout -s KILL 0.9 '" BLOCKLIFT_EXECUTABLE "' sweep study.yaml -o out -q");
  // Workers of a killed study end with it.
  ASSERT_EQ(run("sweep study.yaml -o out -q").exit_code, 0);
  EXPECT_EQ(text_of_file("whole/study.csv"), text_of_file("out/study.csv"));
}

TEST_F(SweepCommand, AssessesAndFindsSobolIndices) {
  write_study(
      "run: assess\ndesign: grid\nfigures: [structure.history.stress_increase_percent]\n"
      "vary: {R1: {keys: [ropes.R1.length], values: [2.99 m, 3.01 m]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o grid -q").exit_code, 0);
  EXPECT_GT(figure("grid", "structure.history.stress_increase_percent")["deviation"], 0);

  write_study(
      "design: sensitivity\nmembers: 32\nfigures: [ropes.R1.max_static_tension_N]\nvary:\n"
      "  weight: {keys: ['block:mass'], spread: {law: uniform, lowest: 7 t, highest: 9 t}}\n"
      "  deaf: {keys: [checks.rope_safety_factor], spread: {law: uniform, lowest: 4, highest: "
      "6}}\n");
  ASSERT_EQ(run("sweep study.yaml -o indices -q").exit_code, 0);
  const auto json = nlohmann::json::parse(text_of_file("indices/study.json"));
  const auto& indices = json["sobol_indices"]["ropes.R1.max_static_tension_N"];
  // The estimate's own error at this size is some 0.2.
  EXPECT_NEAR(indices["weight"]["total"], 1, 0.4);
  EXPECT_NEAR(indices["deaf"]["total"], 0, 1e-3);
  // 128 lifts ran, of which 64 were drawn independently: the others repeat their values.
  EXPECT_EQ(json["members"], 128);
  EXPECT_THAT(text_of_file("indices/study.html"), HasSubstr("is of the first 64 lifts"));
}

// The factor is made once, for the case as it is written: there its stress is that of an
// assessment; the other masses' stress follows from the same unit stresses, whoever computes it.
TEST_F(SweepCommand, FindsTheStressOfAllMembersWithOneFactor) {
  const std::string masses = "design: grid\nfigures: [" + std::string(checked) +
                             "]\nvary: {weight: {keys: ['block:mass'], values: ";
  write_study("run: stress\n" + masses + "[8 t, 8.2 t, 8.4 t]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o one --workers 1 -q").exit_code, 0);
  ASSERT_EQ(run("sweep study.yaml -o two --workers 2 -q").exit_code, 0);
  EXPECT_EQ(text_of_file("one/study.csv"), text_of_file("two/study.csv"));
  const auto stress = figure("one", checked);

  // A member alone, the last, and the whole assessment of the first and the last.
  write_study("run: stress\n" + masses + "[8.4 t]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o alone -q").exit_code, 0);
  EXPECT_EQ(figure("alone", checked)["largest"], stress["largest"]);
  write_study("run: assess\n" + masses + "[8 t, 8.4 t]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o assessed -q").exit_code, 0);
  const auto assessed = figure("assessed", checked);
  const double written = assessed["smallest"].get<double>();
  EXPECT_NEAR(stress["smallest"].get<double>(), written, 1e-8 * written);
  const double heavier = assessed["largest"].get<double>();
  EXPECT_NEAR(stress["largest"].get<double>(), heavier, 0.01 * heavier);  // on a mesh of its own
  EXPECT_TRUE(fs::is_regular_file("one/worst/report.html"));
}

// Where ropes press on the block's edges follows from each member's motion: its stress is that of
// an assessment all the same.
TEST_F(SweepCommand, FindsTheStressOfBlocksWithRopesOnTheirEdges) {
  fs::remove_all("lift");
  fs::create_directory("lift");
  test::SampleLift files = test::sling_over_edge_lift();
  files.block =
      test::with(files.block, "outside: [1, 0, 1],", "outside: [1, 0, 1], friction: 0.2,");
  files.lift_case += "structure: {element_degree: 2, accuracy: 100 %}\n";
  folder_.write("lift/case.yaml", files.lift_case);
  folder_.write("lift/gantry/crane.yaml", files.crane);
  folder_.write("lift/plate.yaml", files.block);
  folder_.write("lift/gantry/ropes/tackle.yaml", files.rope);
  folder_.write("lift/ropes/tackle.yaml", files.rope);
  const std::string lengths = "design: grid\nfigures: [" + std::string(checked) +
                              "]\nvary: {R1: {keys: [ropes.R1.length], values: [4 m, 4.01 m]}}\n";
  write_study("run: stress\n" + lengths);
  ASSERT_EQ(run("sweep study.yaml -o one --workers 1 -q").exit_code, 0);
  ASSERT_EQ(run("sweep study.yaml -o two --workers 2 -q").exit_code, 0);
  EXPECT_EQ(text_of_file("one/study.csv"), text_of_file("two/study.csv"));
  write_study("run: assess\n" + lengths);
  ASSERT_EQ(run("sweep study.yaml -o assessed -q").exit_code, 0);
  for (const char* value : {"smallest", "largest"}) {
    const double assessed = figure("assessed", checked)[value].get<double>();
    EXPECT_GT(assessed, 1e6);
    EXPECT_NEAR(figure("one", checked)[value].get<double>(), assessed, 1e-7 * assessed);
  }
}

TEST_F(SweepCommand, RunsNothingIfAMemberIsImpossible) {
  write_study(
      "members: 24\nvary:\n"
      "  weight: {keys: ['block:mass'], spread: {law: normal, mean: 8 t, deviation: 20 t}}\n");
  const Outcome negative = run("sweep study.yaml -o out");
  EXPECT_EQ(negative.exit_code, 2);
  EXPECT_THAT(negative.err, HasSubstr("must be greater than 0"));
  // At the spread's own line, which is to be mended.
  EXPECT_THAT(negative.err, HasSubstr("study.yaml:5:42: error: a member of the study is "
                                      "impossible: weight = -"));
  write_study("members: 4\nvary: {a: {keys: [ropes.R1.lenght], values: [1 m]}}\n");
  const Outcome unknown = run("sweep study.yaml -o out");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("study.yaml:4:19: error: there is no ropes.R1.lenght"));
  EXPECT_THAT(unknown.err, HasSubstr("\n1 error\n"));
  EXPECT_FALSE(fs::exists("out"));
}

// One cause, one complaint, at the value: what it does to the block's file stands below.
TEST_F(SweepCommand, SaysOneThingOfOneImpossibleValue) {
  for (const std::string& lines :
       {std::string("design: grid\nvary: {w: {keys: ['block:mass'], values: [8 t, -2 t]}}\n"),
        std::string("design: search\nmembers: 8\nminimise: ropes.R1.max_static_tension_N\n"
                    "vary: {w: {keys: ['block:mass'], between: [-9 t, -8 t]}}\n")}) {
    write_study(lines);
    const Outcome outcome = run("sweep study.yaml -o out");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err,
                ::testing::ContainsRegex("study.yaml:[46]:[0-9]+: error: a member of the "
                                         "study is impossible: w = -[0-9]+ kg\n    "));
    EXPECT_THAT(outcome.err, HasSubstr("must be greater than 0"));
    EXPECT_THAT(outcome.err, HasSubstr("\n1 error\n"));
    EXPECT_FALSE(fs::exists("out"));
  }
}

// A block that weighs less than its plates is found before anything runs, by validate as well.
TEST_F(SweepCommand, RunsNothingIfAMemberWeighsLessThanItsPlates) {
  write_study("design: grid\nvary: {w: {keys: ['block:mass'], values: [8 t, 3 t]}}\n");
  for (const char* command : {"sweep study.yaml -o out", "validate study.yaml"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("study.yaml:4:48: error: a member of the study is "
                                       "impossible: w = 3000 kg\n"));
    EXPECT_THAT(outcome.err, HasSubstr("its plates alone weigh"));
    EXPECT_THAT(outcome.err, HasSubstr("\n1 error\n"));
    EXPECT_FALSE(fs::exists("out"));
  }
}

// The lift is set down: a member whose sling is not slack in time fails when it runs.
TEST_F(SweepCommand, FailsWhereTooManyMembersDo) {
  std::string text = text_of_file("lift/case.yaml");
  const std::size_t begin = text.find("operation:"), end = text.find("settle:");
  text.replace(begin, end - begin,
               "operation:\n  - stage: set down\n"
               "    moves: [{drives: [C1.left, C1.right], by: 1.5 m}]\n"
               "    until: {slack: R1, within: 30 s}\n"
               "ground: 0 m\nground_contact: {stiffness: 5 MN/m, damping: 200 kN s/m}\n");
  folder_.write("lift/case.yaml",
                test::with(text, "left: 5 m, right: 5 m", "left: 6.4 m, right: 6.4 m"));
  const auto study = [&](const std::string& design, const std::string& values) {
    write_study(design +
                "figures: [ropes.R1.max_dynamic_tension_N]\n"
                "vary: {within: {keys: ['operation[1].until.within'], values: [" +
                values + "]}}\n");
  };
  // Of a Latin hypercube each of two values is that of half the members.
  study("members: 6\n", "30 s, 0.5 s");
  const Outcome half = run("sweep study.yaml -o half");
  EXPECT_EQ(half.exit_code, 1);
  EXPECT_THAT(half.out, HasSubstr("6 members, 3 failed\n"));
  EXPECT_THAT(half.out, HasSubstr("warning: 3 of 6 members failed"));
  EXPECT_THAT(half.out,
              ::testing::ContainsRegex("warning: member [0-5] failed: stage \"set down\""));
  for (const char* file :
       {"study.csv", "study.h5", "study.json", "study.html", "worst/report.html"})
    EXPECT_TRUE(fs::is_regular_file(fs::path("half") / file)) << file;
  // Gone on with, the failed ones are not tried again, nor forgotten.
  const std::string before = text_of_file("half/study.csv");
  EXPECT_THAT(before, HasSubstr("waits for R1 to go slack"));
  fs::remove("half/study.csv");
  EXPECT_EQ(run("sweep study.yaml -o half -q").exit_code, 1);
  EXPECT_EQ(text_of_file("half/study.csv"), before);

  // One of 20 is 5 % and no more; of a grid each is asked for. The others go on.
  std::string values = "0.5 s";
  for (int i = 0; i < 19; ++i) values += ", 30." + std::to_string(10 + i) + " s";
  study("members: 20\n", values);
  const Outcome one = run("sweep study.yaml -o one");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("warning: 1 of 20 members failed"));
  study("design: grid\n", "30 s, 0.5 s");
  const Outcome grid = run("sweep study.yaml -o grid");
  EXPECT_EQ(grid.exit_code, 1) << grid.err;
  EXPECT_THAT(grid.out, HasSubstr("warning: member 1 failed"));
  EXPECT_THAT(grid.out, HasSubstr("2 members, 1 failed\n"));
  EXPECT_TRUE(fs::is_regular_file("grid/study.html"));
  study("design: grid\n", "0.5 s");
  const Outcome none = run("sweep study.yaml -o none");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("no member of the study ran; the first says: stage"));
}

TEST_F(SweepCommand, SaysWhichMemberIsDamaged) {
  write_study(
      "design: grid\nfigures: [ropes.R1.max_static_tension_N]\n"
      "vary: {w: {keys: ['block:mass'], values: [8 t, 8.1 t]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o out -q").exit_code, 0);
  folder_.write("out/members/000001.json", "{\"member\": 1, \"figu");
  const Outcome damaged = run("sweep study.yaml -o out");
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_THAT(damaged.err, HasSubstr("000001.json is damaged"));
  fs::remove("out/members/000001.json");
  EXPECT_EQ(run("sweep study.yaml -o out -q").exit_code, 0);
}

// "Heights" and "periods" are any lengths and times to the study. Between two heights the limit is
// where the line between their figures passes it, here half way; the time changes nothing at rest.
TEST_F(SweepCommand, FindsLimitsOnAGrid) {
  const std::string load = "ropes.R3.max_static_tension_N";
  const std::string seas = "design: grid\nfigures: [" + load +
                           "]\nvary:\n"
                           "  Hs: {keys: [ropes.R1.length], values: [2.98 m, 3.02 m]}\n"
                           "  Tp: {keys: [settle], values: [1 s, 2 s]}\n";
  write_study(seas);
  ASSERT_EQ(run("sweep study.yaml -o figures -q").exit_code, 0);
  const auto found = figure("figures", load);
  // R1 is longer: R3 of the same hook takes what it leaves.
  ASSERT_GE(found["member_of_largest"], 2);
  const double middle = (found["smallest"].get<double>() + found["largest"].get<double>()) / 2;

  const std::string limits =
      "limits: {height: Hs, period: Tp, scatter: scatter.csv, forecast: "
      "forecast.csv, of: [{figure: " +
      load + ", at: " + std::to_string(middle) + " N}]}\n";
  folder_.write("scatter.csv",
                "significant_height_m,peak_period_s,share\n2.99,1.5,50\n3.01,1.5,30\n0,9,20\n");
  folder_.write("forecast.csv",
                "significant_height_m,peak_period_s,time_h\n2.99,1.5,0\n2.99,2,3\n3.01,1.5,6\n"
                "2.99,1,9\n");
  write_study(seas + limits);
  const Outcome outcome = run("sweep study.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("\n1 +3\\.00\n2 +3\\.00\n"));
  EXPECT_THAT(outcome.out, HasSubstr("scatter table: 50.0 % is workable with alpha 1; 20.0 % has"));
  EXPECT_THAT(outcome.out, HasSubstr("the last window reaches the end of the forecast, 9 h"));
  const auto json = nlohmann::json::parse(text_of_file("out/study.json"));
  for (const auto& state : json["limits"]["sea_states"]) {
    EXPECT_NEAR(state["significant_height_m"].get<double>(), 3, 1e-6);
    EXPECT_EQ(state["known_as"], "found");
    EXPECT_EQ(state["governed_by"], load);
  }
  ASSERT_EQ(json["limits"]["forecast"]["windows"].size(), 2U);
  EXPECT_EQ(json["limits"]["forecast"]["windows"][0]["end_h"], 3);
  EXPECT_TRUE(json["figures"][0]["quantiles"].empty());
  EXPECT_THAT(text_of_file("out/study.html"), HasSubstr("Limiting sea states"));

  // A table that cannot be read is found before anything runs.
  const auto refused = [&](const std::string& text) {
    const Outcome wrong = run("sweep study.yaml -o wrong");
    EXPECT_EQ(wrong.exit_code, 2) << wrong.out;
    EXPECT_THAT(wrong.err, HasSubstr(text));
    EXPECT_FALSE(fs::exists("wrong"));
  };
  folder_.write("forecast.csv", "significant_height_m,peak_period_s,time_h\n1,1,0\n1,1,6\n1,1,3\n");
  refused("forecast.csv:4:1: error: the times of a forecast ascend");
  folder_.write("forecast.csv", "significant_height_m,peak_period_s,time_h\n1,1,0\n1,1\n");
  refused("forecast.csv:3: 2 values; 3 are due");
  folder_.write("forecast.csv", "significant_height_m,peak_period_s,time_h\n");
  refused("the file has no rows");
  folder_.write("forecast.csv", "significant_height_m,peak_period_s,time_h\n1,1,0\n");
  write_study(seas + test::with(limits, std::to_string(middle) + " N", "3 m"));
  refused("its limit has another dimension");
  write_study(seas + test::with(limits, "R3.max", "R33.max"));
  refused("the figure is limited, but not among figures");
}

// What is wrong with the case itself is no member's fault.
TEST_F(SweepCommand, SaysWhatIsWrongWithTheCaseItselfAlone) {
  folder_.write("study.yaml", std::string("study: spread\ncase: elsewhere\n") + weight);
  const Outcome outcome = run("sweep study.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("study.yaml:2:7: error: there is no case \"elsewhere\"\n"));
  EXPECT_THAT(outcome.err, HasSubstr("\n1 error\n"));
  EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("a member of the study")));
}

// Which figures a lift has its first member tells.
TEST_F(SweepCommand, RefusesFiguresThatTheLiftDoesNotHave) {
  write_study(
      std::string("figures: [ropes.R2.max_static_tension_N, ropes.R1.max_static_tensio_N]\n") +
      weight);
  const Outcome outcome = run("sweep study.yaml -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("study.yaml:3:42: error: the lift's summary has no figure "
                                     "\"ropes.R1.max_static_tensio_N\"\n"
                                     "    did you mean \"ropes.R1.max_static_tension_N\"?"));
  EXPECT_FALSE(fs::exists("out"));
}

// Tensions at rest are in proportion to the weight: the lightest that pulls 18 kN at R2 is known.
TEST_F(SweepCommand, SearchesForTheBestWithinBounds) {
  write_study(
      "design: grid\nfigures: [ropes.R2.max_static_tension_N]\n"
      "vary: {weight: {keys: ['block:mass'], values: [8 t]}}\n");
  ASSERT_EQ(run("sweep study.yaml -o one -q").exit_code, 0);
  const double at_8_t = figure("one", "ropes.R2.max_static_tension_N")["mean"].get<double>();
  const std::string search =
      "design: search\nmembers: 40\nminimise: ropes.R1.max_static_tension_N\n"
      "vary: {weight: {keys: ['block:mass'], between: [7 t, 9 t]}}\n";
  write_study(search + "subject_to: [{figure: ropes.R2.max_static_tension_N, at_least: " +
              std::to_string(at_8_t / 1000) + " kN}]\n");
  const Outcome outcome = run("sweep study.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("smallest ropes, R1, max static tension"));
  EXPECT_THAT(outcome.out, HasSubstr("reached"));
  const auto found = nlohmann::json::parse(text_of_file("out/study.json"))["search"];
  EXPECT_TRUE(found["is_feasible"].get<bool>());
  // Steps end at 2 kg.
  EXPECT_NEAR(found["variables"]["weight"]["value"].get<double>(), 8000, 8);
  EXPECT_TRUE(fs::is_regular_file("out/best/report.html"));
  EXPECT_THAT(text_of_file("out/study.html"), HasSubstr("best so far"));

  // A killed search takes what is done.
  fs::create_directories("killed");
  fs::copy("out/members", "killed/members", fs::copy_options::recursive);
  fs::remove("killed/members/000010.json");
  ASSERT_EQ(run("sweep study.yaml -o killed -q").exit_code, 0);
  EXPECT_EQ(text_of_file("out/study.json"), text_of_file("killed/study.json"));

  write_study(search +
              "subject_to: [{figure: ropes.R2.max_static_tension_N, at_least: 90 kN}, "
              "{figure: 'measures.load: tilt.static', at_most: 45 deg}]\n");
  const Outcome none = run("sweep study.yaml -o none");
  EXPECT_EQ(none.exit_code, 3) << none.err;
  EXPECT_THAT(none.out, HasSubstr("no member keeps to all bounds"));
  EXPECT_THAT(none.out, HasSubstr("<= 45.00 °"));
  EXPECT_THAT(none.out, HasSubstr("missed"));
  EXPECT_THAT(none.out, ::testing::Not(HasSubstr("reached")));
  const auto bounds = nlohmann::json::parse(text_of_file("none/study.json"))["search"]["bounds"];
  EXPECT_TRUE(bounds[0]["is_exceeded"].get<bool>());
  EXPECT_FALSE(bounds[0]["is_active"].get<bool>());
  EXPECT_FALSE(bounds[1]["is_exceeded"].get<bool>());

  write_study(search + "subject_to: [{figure: ropes.R2.max_static_tension_N, at_most: 1 kN}]\n");
  const Outcome beyond = run("sweep study.yaml -o beyond");
  EXPECT_EQ(beyond.exit_code, 3) << beyond.err;
  EXPECT_THAT(beyond.out, HasSubstr("exceeded"));
  EXPECT_THAT(beyond.out, ::testing::Not(HasSubstr("reached")));
  EXPECT_THAT(text_of_file("beyond/study.html"), HasSubstr("<td>exceeded</td>"));
}

// What was "measured" is the tension of a lift whose sling is softer than the case says.
TEST_F(SweepCommand, FindsTheStiffnessThatFitsAMeasurement) {
  const std::string lift_case = text_of_file("lift/case.yaml");
  std::string softer = lift_case;
  softer.replace(softer.find("30 MN"), 5, "18 MN");  // of R1, the first
  folder_.write("lift/case.yaml", softer);
  ASSERT_EQ(run("simulate lift -o softer --csv -q").exit_code, 0);
  std::ifstream table("softer/results.csv");
  std::string line, record = "time,tension\n";
  std::getline(table, line);
  ASSERT_THAT(line, ::testing::StartsWith("time [s],C1.left.tension [N],C1.right.tension [N],R1."));
  while (std::getline(table, line)) {
    std::size_t begin = 0;
    for (int column = 0; column < 3; ++column) begin = line.find(',', begin) + 1;
    record += line.substr(0, line.find(',') + 1) +
              line.substr(begin, line.find(',', begin) - begin) + '\n';
  }
  folder_.write("lift/R1.csv", record);
  folder_.write("lift/case.yaml",
                lift_case + "compare: {source: a cell, series: {R1: {file: R1.csv, unit: N}}}\n");
  write_study(
      "design: search\nmembers: 30\n"
      "vary: {k: {keys: [ropes.R1.model.axial_stiffness], between: [10 MN, 50 MN]}}\n"
      "minimise: comparison.series.R1.mean_difference_percent\n");
  const Outcome outcome = run("sweep study.yaml -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(text_of_file("out/best/summary.json"));
  EXPECT_LT(summary["comparison"]["series"][0]["mean_difference_percent"].get<double>(), 0.01);
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("k +1[78]\\.[0-9]+ MN"));
}

TEST_F(SweepCommand, SaysWhatIsWrongWithASearch) {
  const auto refused = [&](const std::string& lines, const std::string& text) {
    write_study(lines);
    const Outcome outcome = run("sweep study.yaml -o out");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(fs::exists("out"));
  };
  const std::string vary = "vary: {weight: {keys: ['block:mass'], between: [7 t, 9 t]}}\n";
  const std::string search = "design: search\nmembers: 40\n" + vary;
  refused(search, "a search needs minimise or maximise, and not both");
  refused(search + "minimise: ropes.R1.max_static_tensionN\n",
          "did you mean \"ropes.R1.max_static_tension_N\"?");
  refused(search +
              "minimise: ropes.R1.max_static_tension_N\n"
              "subject_to: [{figure: ropes.R2.max_static_tension_N, at_least: 3 m}]\n",
          "its limit has another dimension");
  refused(
      "design: search\nmembers: 40\nminimise: ropes.R1.max_static_tension_N\n"
      "vary: {weight: {keys: ['block:mass'], between: [9 t, 7 t]}}\n",
      "the second bound is not above the first");
  refused("members: 40\nminimise: ropes.R1.max_static_tension_N\n" + vary,
          "minimise, maximise and subject_to go with design: search");
}

TEST_F(SweepCommand, RefusesAFolderOfAnotherStudy) {
  ASSERT_EQ(run("sweep study.yaml -o out -q").exit_code, 0);
  write_study(std::string(weight) + "seed: 2\n");
  const Outcome other = run("sweep study.yaml -o out");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("members of another study"));
}

// Another run is one that holds the lock of the folder. Parts bear each other.
TEST_F(SweepCommand, RefusesAFolderInWhichAnotherRunIsAtWork) {
  ASSERT_EQ(run("sweep study.yaml --part 1/12 -o out -q").exit_code, 0);
  const int lock = ::open("out/members/lock", O_RDWR | O_CLOEXEC);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(::flock(lock, LOCK_SH), 0);
  EXPECT_EQ(run("sweep study.yaml --part 2/12 -o out -q").exit_code, 0);
  const Outcome whole = run("sweep study.yaml -o out -q");
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_THAT(whole.err, HasSubstr("out: error: another run of a study is at work in this folder"));
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  EXPECT_EQ(run("sweep study.yaml --part 3/12 -o out -q").exit_code, 2);
  ::close(lock);
  EXPECT_EQ(run("sweep study.yaml --part 3/12 -o out -q").exit_code, 0);
}

}  // namespace
}  // namespace blocklift::pipeline
