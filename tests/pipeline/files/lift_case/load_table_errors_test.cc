// What is said of cases with a load table that cannot be.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/files/lift_case/lift_case_complaints.h"

namespace blocklift::pipeline {
namespace {

using test::complaints_about;
using test::SampleLift;
using test::with;
using ::testing::HasSubstr;

TEST(LoadTableErrors, LugsThatDoNotFit) {
  SampleLift lift;
  lift.lift_case = with(test::sample_load_table_case, "dynamic: {L1: 6 t, L2: 6 t}",
                        "dynamic: {L1: 6 t, L3: 6 t}\ncranes: {C1: {model: gantry, start: {}}}");
  EXPECT_EQ(
      complaints_about(lift),
      "case.yaml:5:21: error: lug L2 is missing under dynamic of the load table\n"
      "case.yaml:6:22: error: the load table names lug \"L3\", which block plate does not have\n"
      "    its lugs are L1, L2; did you mean \"L1\"?\n"
      "case.yaml:7:1: error: the case has a load table, and cranes\n"
      "    a load table stands in place of cranes, ropes, supports, wind, sea and operation, and "
      "nothing moves\n"
      "3 errors\n");
}

/// What is said of the sample's load table with more lines behind it, which begin in line 7.
std::string complaints_beside_load_table(const std::string& lines) {
  SampleLift lift;
  lift.lift_case = test::sample_load_table_case + lines;
  return complaints_about(lift);
}

TEST(LoadTableErrors, LimitsThatNothingWouldRead) {
  EXPECT_EQ(complaints_beside_load_table("checks: {yield_factor: 1.5, buckling_factor: 1.2}\n"),
            "");
  EXPECT_EQ(complaints_beside_load_table("checks:\n  yield_factor: 1.5\n  swing: 3 deg\n"
                                         "  rope_safety_factor: 5\n"),
            "case.yaml:9:3: error: checks has swing, and the case has a load table\n"
            "    a load table says nothing of where load, ropes and cranes are: the limit would "
            "hold nothing\n"
            "case.yaml:10:3: error: checks has rope_safety_factor, and the case has a load table\n"
            "    a load table has no ropes, cranes and spreaders: their checks are those of a lift "
            "that is simulated\n"
            "2 errors\n");
}

TEST(LoadTableErrors, EveryKeyThatNothingWouldReadIsRefused) {
  for (const char* line : {"checks: {tilt: 3 deg}",
                           "checks: {sling_angle: 60 deg}",
                           "checks: {offlead: 3 deg}",
                           "checks: {clearance: 1 m}",
                           "checks: {righting_height: 1 m}",
                           "checks: {heel: 3 deg}",
                           "checks: {crane_capacity: false}",
                           "checks: {smallest_tension: 1 kN}",
                           "settle: 5 s",
                           "faults: []",
                           "dynamics: {sample_interval: 0.1 s}",
                           "sling_tolerance: 1 %",
                           "rope_weight: true",
                           "ground: 1 m",
                           "tuggers: {}",
                           "moorings: {}",
                           "sea: {}",
                           "structure: {stress_points: {a: [0 m, 0 m, 0 m]}}",
                           "structure: {fatigue: {lifts: 9}}",
                           "compare: {source: s, ropes: {L1: {static: 1 t}}}"}) {
    SCOPED_TRACE(line);
    EXPECT_THAT(complaints_beside_load_table(std::string(line) + "\n"),
                HasSubstr("the case has a load table"));
  }
  for (const char* key : {"position: [0 m, 0 m, 1 m]", "orientation: [0 deg, 5 deg, 0 deg]"}) {
    SCOPED_TRACE(key);
    SampleLift lift;
    lift.lift_case = with(test::sample_load_table_case, "load: {model: plate}",
                          "load: {model: plate, " + std::string(key) + "}");
    EXPECT_THAT(complaints_about(lift),
                HasSubstr("and the case has a load table\n    a load table acts on the block in "
                          "its own frame"));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
