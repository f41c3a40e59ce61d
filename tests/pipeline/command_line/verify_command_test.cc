// `blocklift verify` as a user meets it: run as a process.

#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using test::Outcome;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

/// Run in an empty folder: the suite needs nothing of where the user is.
class VerifyCommand : public ::testing::Test {
 protected:
  static Outcome run(const std::string& arguments) {
    return test::run_blocklift("verify " + arguments);
  }
  const TemporaryFolder folder_;
};

TEST_F(VerifyCommand, PrintsALineForEachFigure) {
  const Outcome outcome = run("--only open-chains");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(test::only_progress));
  EXPECT_THAT(outcome.out, HasSubstr("reference"));
  EXPECT_THAT(outcome.out, HasSubstr("open-chains"));
  EXPECT_THAT(outcome.out, HasSubstr("-4.905"));
  EXPECT_THAT(outcome.out, HasSubstr("pass"));
  EXPECT_THAT(outcome.out, HasSubstr("Felis 2017"));
  EXPECT_THAT(outcome.out, HasSubstr("\n6 of 6 figures agree with their references ("));
}

TEST_F(VerifyCommand, JsonHasTheFieldsOfEachFigure) {
  const Outcome outcome = run("--json --only open-chains --only 'trus*'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = nlohmann::json::parse(outcome.out)["results"];
  ASSERT_EQ(results.size(), 9u);
  std::set<std::string> stages;
  for (const auto& row : results) {
    for (const char* text : {"name", "stage", "quantity", "unit", "source"})
      EXPECT_TRUE(row.at(text).is_string()) << text;
    EXPECT_EQ(row.at("pass"), row.at("error") <= row.at("tolerance"));
    const double difference = row.at("computed").get<double>() - row.at("reference").get<double>();
    EXPECT_EQ(row.at("error").get<double>(), std::abs(difference));
    stages.insert(row.at("stage").get<std::string>());
  }
  EXPECT_EQ(stages, (std::set<std::string>{"dynamics", "structure"}));
}

TEST_F(VerifyCommand, ListsTheCasesOfAPattern) {
  const Outcome all = run("--list");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("dynamics/open-chains"));
  EXPECT_THAT(all.out, HasSubstr("structure/nafems-le6"));
  const Outcome some = run("--list --only structure/*");
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.out, Not(HasSubstr("open-chains")));
  EXPECT_THAT(some.out, HasSubstr("structure/square-plates"));
}

TEST_F(VerifyCommand, APatternThatMatchesNothingIsAnErrorWithTheList) {
  const Outcome outcome = run("--only open-chain --only opn-chains");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("no verification case matches \"opn-chains\""));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean \"open-chains\"?"));
  EXPECT_THAT(outcome.err, HasSubstr("\n        structure/nafems-le6\n"));
}

}  // namespace
}  // namespace blocklift::pipeline
