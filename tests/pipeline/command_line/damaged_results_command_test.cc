// `blocklift report`, `compare` and `measured` with results of a real lift that were damaged: the
// exit code is 0 or 2, never a crash, a message names the file, and nothing is written.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/damage.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Damage;
using test::Outcome;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class DamagedResultsCommand : public ::testing::Test {
 protected:
  DamagedResultsCommand() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    const Outcome made = run("assess lift -o sound");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    std::string record = "time [s],ropes.R1 [kN]\n";
    for (int i = 1; i < 15; ++i) record += std::to_string(i) + (i % 2 == 0 ? ",25\n" : ",26\n");
    folder_.write("record.csv", record);
    const Outcome held = run("measured sound record.csv --shift 0");
    EXPECT_EQ(held.exit_code, 0) << held.err;
  }

  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }

  /// One of the commands on the results in `tried`, each of them once in every five calls.
  void expect_answer() {
    const std::vector<std::string> commands{
        "report tried", "report tried --paraview --frames 2", "compare sound tried -o page.html",
        "measured tried record.csv --shift 0 -o page.html", "expect tried -o figures.json"};
    const std::string& command = commands[next_++ % commands.size()];
    SCOPED_TRACE(command);
    fs::remove("page.html");
    fs::remove("figures.json");
    const Outcome outcome = run(command);
    EXPECT_THAT(outcome.exit_code, AnyOf(0, 2)) << outcome.err;
    if (outcome.exit_code == 0) return;
    ++refused_;
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr("tried/results.h5: "),
                                   HasSubstr("tried/summary.json: "), HasSubstr("record.csv:")));
    EXPECT_THAT(outcome.err, HasSubstr("error: "));
    for (const char* file : {"page.html", "figures.json", "tried/report.html", "tried/lift.pvd"})
      EXPECT_FALSE(fs::exists(file)) << file;
  }

  /// Damages a copy of the sound results.
  void damage(const std::function<void()>& way) {
    fs::remove_all("tried");
    fs::create_directory("tried");
    for (const char* file : {"results.h5", "summary.json"})
      fs::copy(fs::path("sound") / file, fs::path("tried") / file);
    way();
    expect_answer();
  }

  const test::TemporaryFolder folder_;
  std::size_t next_ = 0;
  int refused_ = 0;
};

TEST_F(DamagedResultsCommand, EndsWithAMessageWhereAFileWasCut) {
  for (const char* file : {"tried/results.h5", "tried/summary.json"})
    for (int part = 0; part < 20; ++part) {
      SCOPED_TRACE(std::string(file) + " at " + std::to_string(part) + " of 20");
      damage([&] { test::cut(file, part / 20.0); });
    }
  EXPECT_EQ(refused_, 40);
}

TEST_F(DamagedResultsCommand, EndsWithAMessageOrResultsWhereBytesWereFlipped) {
  for (const char* file : {"tried/results.h5", "tried/summary.json"})
    for (int part = 0; part < 20; ++part) {
      SCOPED_TRACE(std::string(file) + " at " + std::to_string(part) + " of 20");
      damage([&] { test::flip_bytes(file, (part + 0.37) / 20, 64); });
    }
  EXPECT_GE(refused_, 20);
}

TEST_F(DamagedResultsCommand, NamesTheDatasetThatWasChanged) {
  // Every third is tried: the unit tests try all, each in all ways.
  const std::vector<std::string> datasets = test::datasets_of("sound/results.h5");
  for (std::size_t i = 0; i < datasets.size(); i += 3) {
    const std::string& dataset = datasets[i];
    const Damage chosen = test::all_damage[i % std::size(test::all_damage)];
    SCOPED_TRACE(dataset + " damaged in way " + std::to_string(static_cast<int>(chosen)));
    damage([&] { test::damage("tried/results.h5", dataset, chosen); });
  }
  EXPECT_GT(refused_, 5);
  damage([] { test::damage("tried/results.h5", "/dynamic/ropes/R1/tension", Damage::text); });
  const Outcome outcome = run("report tried");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("tried/results.h5: error: \"/dynamic/ropes/R1/tension\": holds texts; "
                      "numbers are due"),
            HasSubstr("1 error")));
}

}  // namespace
}  // namespace blocklift::pipeline
