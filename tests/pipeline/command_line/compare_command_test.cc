// `blocklift compare`, `blocklift expect` and `blocklift assess --expect` as a user meets them.
#include <filesystem>
#include <string>

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
using test::text_of_file;
using ::testing::HasSubstr;
using ::testing::Not;

/// Runs the program on the small lift's files, to be changed at will.
class CompareCommand : public ::testing::Test {
 protected:
  CompareCommand() { fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive); }

  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }
  void change(const std::string& file, const std::string& old_passage,
              const std::string& new_passage) const {
    const fs::path path = fs::path("lift") / file;
    folder_.write(path, test::with(text_of_file(path), old_passage, new_passage));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(CompareCommand, HoldsALiftToWhatItWasAndFindsWhatMoved) {
  ASSERT_EQ(run("assess lift").exit_code, 0);
  ASSERT_EQ(run("expect lift -o figures.json").exit_code, 0);
  const std::string first_figures = text_of_file("figures.json");
  const Outcome again = run("assess lift -o again --expect figures.json");
  EXPECT_EQ(again.exit_code, 0) << again.out;
  EXPECT_THAT(again.out, HasSubstr("expected figures: all "));
  EXPECT_EQ(run("compare lift again --tolerance 'ropes=0%,structure=0%,checks=0%'").exit_code, 0);

  change("block.yaml", "mass: 8 t", "mass: 9 t");
  const Outcome heavier = run("assess lift -o heavier --expect figures.json");
  EXPECT_EQ(heavier.exit_code, 3);
  EXPECT_THAT(heavier.out, HasSubstr("not as expected: ropes.R1.max_static_tension_N is "));
  EXPECT_THAT(heavier.out, HasSubstr("verdict: pass"));

  // The block is one of the case's models, and the first result's is still what it was.
  const Outcome compared = run("compare again heavier --tolerance ropes=5% -o page.html");
  EXPECT_EQ(compared.exit_code, 3) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr(" block\n  mass\n    again    8 t\n    heavier  9 t\n"));
  EXPECT_THAT(compared.out, HasSubstr("ropes.R1.max_static_tension_N of heavier: "));
  EXPECT_TRUE(fs::exists("page.html"));
  EXPECT_EQ(run("compare again heavier").exit_code, 0);
  const auto json = nlohmann::json::parse(run("compare again heavier --json").out);
  EXPECT_EQ(json["input"].size(), 1u);

  EXPECT_EQ(run("expect heavier -o figures.json").exit_code, 2);
  EXPECT_EQ(text_of_file("figures.json"), first_figures);
  const Outcome renewed = run("expect heavier -o figures.json --renew");
  EXPECT_EQ(renewed.exit_code, 0) << renewed.err;
  EXPECT_THAT(renewed.out, HasSubstr("renewed: ropes.R1.max_static_tension_N is "));
  EXPECT_NE(text_of_file("figures.json"), first_figures);
  folder_.write(
      "figures.yaml",
      "- {figure: ropes.R1.max_static_tension_N, value: 1, tolerance: 0.01, reason: r}\n");
  ASSERT_EQ(run("expect heavier -o figures.yaml --renew").exit_code, 0);
  EXPECT_THAT(text_of_file("figures.yaml"),
              ::testing::StartsWith("- figure: \"ropes.R1.max_static_tension_N\"\n  value: "));
}

// The small lift's bounce is damped too much.
TEST_F(CompareCommand, WarnsOfWhatTheSummaryWarnsOf) {
  const Outcome outcome = run("assess lift -o out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto warnings = nlohmann::json::parse(text_of_file("out/summary.json"))["warnings"];
  ASSERT_FALSE(warnings.empty());
  std::size_t said = 0;
  for (auto at = outcome.out.find("warning: "); at != std::string::npos;
       at = outcome.out.find("warning: ", at + 1))
    ++said;
  EXPECT_EQ(said, warnings.size()) << outcome.out;
  for (const auto& warning : warnings)
    EXPECT_THAT(outcome.out, HasSubstr("warning: " + warning.get<std::string>().substr(0, 20)));
}

TEST_F(CompareCommand, SetsKeysOfTheCaseAndOfItsModels) {
  ASSERT_EQ(run("assess -o plain lift").exit_code, 0);
  const Outcome set =
      run("assess --set 'ropes.R1.length=3.01 m' --set block:mass='9 t' lift -o changed");
  ASSERT_EQ(set.exit_code, 0) << set.err;
  const auto json = nlohmann::json::parse(run("compare plain changed --json").out);
  ASSERT_EQ(json["input"].size(), 2u) << json["input"];
  EXPECT_EQ(json["input"][0]["key"], "ropes.R1.length");
  EXPECT_EQ(json["input"][0]["values"][1], "3.01 m");
  EXPECT_EQ(json["input"][1]["file"], "block");
  EXPECT_EQ(json["input"][1]["values"][1], "9 t");
  // The same by the files themselves gives the same figures.
  change(
      "case.yaml",
      "L1, model: {axial_stiffness: 30 MN, damping_time: 20 ms, breaking_load: 30 t}, length: 3 m",
      "L1, model: {axial_stiffness: 30 MN, damping_time: 20 ms, breaking_load: 30 t}, length: 3.01 "
      "m");
  change("block.yaml", "mass: 8 t", "mass: 9 t");
  ASSERT_EQ(run("assess lift -o written").exit_code, 0);
  const Outcome same = run("compare changed written --tolerance 'ropes=0%,structure=0%'");
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_THAT(same.out, HasSubstr("input: no key differs"));
}

TEST_F(CompareCommand, RefusesKeysThatAreNotThereAndValuesThatCannotBe) {
  const Outcome outcome =
      run("assess lift --set block:mas='9 t' --set blok:mass='9 t' --set ropes.R9.length='1 m'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean \"mass\"?"));
  EXPECT_THAT(outcome.err, HasSubstr("the case has no model \"blok\" to change"));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean \"R1\"?"));
  const Outcome negative = run("assess lift --set block:mass='-9 t'");
  EXPECT_EQ(negative.exit_code, 2);
  EXPECT_THAT(negative.err, HasSubstr("lift/block.yaml:5:"));
  EXPECT_FALSE(fs::exists("results"));
}

TEST_F(CompareCommand, RefusesWhatItCannotUseBeforeAnythingRuns) {
  folder_.write("figures.json", "[{\"figure\": \"verdict\"}]");
  const Outcome outcome = run("assess lift --expect figures.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("figures.json:1:2: error: figure verdict has no requirements"));
  EXPECT_FALSE(fs::exists("results"));
  const Outcome unassessed = run("compare lift lift");
  EXPECT_EQ(unassessed.exit_code, 2);
  EXPECT_THAT(unassessed.err, HasSubstr("the case has no results"));
  EXPECT_EQ(run("compare lift").exit_code, 2);
  EXPECT_EQ(run("expect lift --renew").exit_code, 2);
}

}  // namespace
}  // namespace blocklift::pipeline
