// What floats, given wrongly: `blocklift validate` and `simulate` as a user meets them.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/input/sample_lift.h"
#include "tests/pipeline/run_program.h"

namespace blocklift::pipeline {
namespace {

using test::Outcome;
using test::with;
using ::testing::HasSubstr;

constexpr auto barge = R"(kind: vessel
hull: {barge: {length: 20 m, breadth: 10 m, depth: 4 m}}
panel_size: 2 m
mass: 410 t
centre_of_mass: [0 m, 0 m, 2 m]
radii_of_gyration: [3 m, 6 m, 6 m]
)";

const std::string pair = R"(mechanism: pair
sea:
  waves: {regular: {amplitude: 0.2 m, period: 8 s, heading: 30 deg}}
  radiation: {highest_frequency: 1.2 rad/s}
vessels:
  B1: {model: barge, position: [0 m, -10 m]}
  B2: {model: barge, position: [0 m, 10 m]}
simulate: {duration: 1 s, relative_tolerance: 1e-6}
)";

class AfloatCommand : public ::testing::Test {
 protected:
  AfloatCommand() { folder_.write("barge.yaml", barge); }

  /// What is said of the file with a passage changed.
  std::string complaint(const std::string& command, const std::string& from,
                        const std::string& to) const {
    folder_.write("pair.yaml", with(pair, from, to));
    const Outcome outcome = test::run_program(BLOCKLIFT_EXECUTABLE, command + " pair.yaml");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  }

  test::TemporaryFolder folder_;
};

TEST_F(AfloatCommand, RefusesWavesThatCannotBe) {
  EXPECT_THAT(complaint("simulate", "0.2 m, period: 8 s", "9 m, period: 8 s"),
              HasSubstr("pair.yaml:3:10: error: a wave with the period 8 s and the height of 18 m "
                        "breaks: at most"));
  EXPECT_THAT(complaint("simulate", "period: 8 s", "period: 2.5 s"),
              HasSubstr("pair.yaml:3:10: error: vessel B1: hull "));
  EXPECT_THAT(complaint("simulate", "period: 8 s, ", ""),
              HasSubstr("pair.yaml:3:20: error: a regular wave needs either its frequency or its "
                        "period"));
  EXPECT_THAT(complaint("simulate", "1.2 rad/s", "6 rad/s"),
              HasSubstr("pair.yaml:4:14: error: at 6 rad/s waves are 1.71"));
  EXPECT_THAT(complaint("validate", "highest_frequency: 1.2 rad/s", "frequencies: 0"),
              HasSubstr("pair.yaml:4:28: error: "));
}

TEST_F(AfloatCommand, RefusesVesselsInEachOthersWay) {
  EXPECT_THAT(complaint("validate", "[0 m, 10 m]", "[19 m, -1 m]"),
              HasSubstr("pair.yaml:7:3: error: vessel B1 and vessel B2 intersect, at ("));
  EXPECT_THAT(complaint("simulate", "[0 m, 10 m]", "[0 m, -10 m]"),
              HasSubstr("hulls must be apart, above the water and below: move one of them"));
}

}  // namespace
}  // namespace blocklift::pipeline
