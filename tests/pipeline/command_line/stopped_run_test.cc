// An assessment that is killed goes on with what it had done, with the same figures bit for bit.

#include <cstdlib>
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
using test::TemporaryFolder;
using test::text_of_file;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kept = "results/.unfinished";
constexpr const char* goes_on = "going on with what a run that was stopped had done";

/// The small lift in a folder of its own; its block gives way and its mesh is refined.
class StoppedRun : public ::testing::Test {
 protected:
  StoppedRun() {
    fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive);
    std::string text = text_of_file("lift/case.yaml");
    text.replace(text.find("static_interval: 1 s"), 20, "static_interval: 1 s, flexibility: modal");
    folder_.write("lift/case.yaml", text);
    ::setenv("BLOCKLIFT_KEEP_AFTER", "0", 1);
  }
  ~StoppedRun() override { ::unsetenv("BLOCKLIFT_KEEP_AFTER"); }

  const TemporaryFolder folder_;
};

Outcome assess(const std::string& more = "") {
  return test::run_blocklift("assess lift -o results " + more);
}

/// Kills the program at a rename: files are kept and results come into place by renames alone.
Outcome assess_until_rename(int at) {
  return test::run_command("( LD_PRELOAD='" BLOCKLIFT_FAILING_CALLS
                           "' BLOCKLIFT_FAIL_CALL=rename "
                           "BLOCKLIFT_FAIL_AT=" +
                           std::to_string(at) +
                           " BLOCKLIFT_FAIL_HOW=kill '" BLOCKLIFT_EXECUTABLE
                           "' assess lift -o results )");
}

/// The figures of the results: all of the summary but the run's name, its date and times of
/// computing.
nlohmann::json figures() {
  nlohmann::json summary = nlohmann::json::parse(text_of_file("results/summary.json"));
  EXPECT_EQ(summary.erase("run"), 1);
  EXPECT_EQ(summary.erase("timing"), 1);
  EXPECT_EQ(summary.erase("created"), 1);
  EXPECT_EQ(summary.at("solver").erase("times_faster_than_real_time"), 1);
  return summary;
}

std::string changes(const nlohmann::json& expected) {
  return nlohmann::json::diff(expected, figures()).dump().substr(0, 1000);
}

TEST_F(StoppedRun, GoesOnWithTheSameFiguresWhereverItWasKilled) {
  ASSERT_EQ(assess().exit_code, 0);
  const nlohmann::json expected = figures();
  int resumed = 0, parts = 0;
  for (int at = 1; at < 20; ++at) {
    fs::remove_all("results");
    const Outcome stopped = assess_until_rename(at);
    ASSERT_EQ(stopped.exit_code, 137) << stopped.err;
    if (fs::exists("results/.in-preparation/moves.txt")) break;  // its results were all there
    EXPECT_FALSE(fs::exists("results/summary.json"));
    const Outcome again = assess();
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(changes(expected), "[]") << "killed at rename " << at;
    EXPECT_FALSE(fs::exists(kept));
    const bool goes_on_here = again.out.find(goes_on) != std::string::npos;
    EXPECT_TRUE(goes_on_here || at <= 2) << at << ": " << again.out;
    resumed += goes_on_here ? 1 : 0;
    parts +=
        again.out.find("flexibility of the block, mesh of the block, motion") != std::string::npos
            ? 1
            : 0;
  }
  EXPECT_GE(resumed, 4);
  EXPECT_GE(parts, 2);
}

TEST_F(StoppedRun, OfOtherInputOrThreadsIsNotGoneOnWith) {
  ASSERT_EQ(assess_until_rename(4).exit_code, 137);
  const Outcome other = assess("--set settle='2 s'");
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.out, HasSubstr("a run that was stopped here is not gone on with: it had "
                                   "another input\n"));
  EXPECT_THAT(other.out, Not(HasSubstr(goes_on)));
  fs::remove_all("results");
  ASSERT_EQ(assess_until_rename(4).exit_code, 137);
  EXPECT_THAT(assess("--threads 3").out, HasSubstr("it had another arithmetic of the processor\n"));
}

TEST_F(StoppedRun, PartsThatAreDamagedAreMadeAgain) {
  ASSERT_EQ(assess().exit_code, 0);
  const nlohmann::json expected = figures();
  fs::remove_all("results");
  ASSERT_EQ(assess_until_rename(4).exit_code, 137);
  for (const auto& entry : fs::directory_iterator(kept)) {
    if (entry.path().extension() != ".part") continue;
    std::string bytes = text_of_file(entry.path());
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    folder_.write(entry.path(), bytes);
  }
  EXPECT_EQ(assess().exit_code, 0);
  EXPECT_EQ(changes(expected), "[]");
}

// A short run keeps nothing: it is as quick to do it again.
// Parts are kept of runs that have taken some time, ten seconds if nothing else is asked; here an
// hour, since a busy machine may take more than ten seconds.
TEST_F(StoppedRun, OfAShortRunKeepsNothing) {
  ::setenv("BLOCKLIFT_KEEP_AFTER", "3600", 1);
  ASSERT_EQ(assess_until_rename(1).exit_code, 137);
  EXPECT_FALSE(fs::exists(kept));
}

}  // namespace
}  // namespace blocklift::pipeline
