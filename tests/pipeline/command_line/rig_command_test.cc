// `blocklift rig` as a user meets it: run as a process on the small lift.

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/command_line/run_blocklift.h"
#include "tests/pipeline/rigging/sample_stock.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of_file;
using ::testing::HasSubstr;

class RigCommand : public ::testing::Test {
 protected:
  RigCommand() { fs::copy(BLOCKLIFT_SMALL_LIFT, "lift", fs::copy_options::recursive); }
  static Outcome run(const std::string& arguments) { return test::run_blocklift(arguments); }
  const test::TemporaryFolder folder_;
};

TEST_F(RigCommand, ChoosesFromTheShippedStockAndWritesTheCase) {
  const Outcome outcome = run("rig lift --write lift/rigged.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("governing check"));
  EXPECT_THAT(outcome.out, HasSubstr("sling-6x36-"));
  EXPECT_THAT(outcome.out, HasSubstr("bow-"));
  EXPECT_THAT(outcome.out, HasSubstr(" governs: "));
  EXPECT_THAT(outcome.out, HasSubstr("the choice stands after "));
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(text_of_file("lift/rigged.yaml"), HasSubstr("ropes/sling-6x36-"));
  EXPECT_EQ(run("validate lift/rigged.yaml").exit_code, 0);
  // Chosen once, the slings stand in the first run that begins with them.
  EXPECT_THAT(run("rig lift/rigged.yaml").out, HasSubstr("the choice stands after 2 runs"));
}

TEST_F(RigCommand, FailsWithOnesOwnStockThatIsTooWeak) {
  folder_.write("loft/slings.yaml", test::sling_file({20, 30}));
  const Outcome outcome = run("rig lift --stock loft --write lift/rigged.yaml");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("no sling of the stock passes for R1: s30 comes nearest"));
  EXPECT_THAT(outcome.out, HasSubstr("lift/rigged.yaml is not written"));
  EXPECT_THAT(outcome.out, HasSubstr("the stock has no shackles"));
  EXPECT_FALSE(fs::exists("lift/rigged.yaml"));
}

TEST_F(RigCommand, RefusesWhatIsNoStock) {
  EXPECT_EQ(run("rig lift --stock nowhere").exit_code, 2);
  EXPECT_EQ(run("rig lift --construction hemp").exit_code, 2);
  folder_.write("loft/slings.yaml", "kind: rigging\ntitle: no source\n");
  const Outcome outcome = run("rig lift --stock loft");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("loft/slings.yaml:1:1: error: rigging lacks the key "
                                     "\"source\""));
}

}  // namespace
}  // namespace blocklift::pipeline
