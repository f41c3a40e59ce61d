// What is said of the keys of a crane: charts, deratings, reevings, what it stands on.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/files/lift_case/lift_case_complaints.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

/// What is said of the sample's crane with these lines at its end.
std::string complaints_of_crane(const std::string& lines, const std::string& at_left = "") {
  test::SampleLift parts;
  parts.crane += lines;
  if (!at_left.empty())
    parts.crane = test::with(parts.crane, "    crane_stiffness: 10 MN/m\n",
                             "    crane_stiffness: 10 MN/m\n" + at_left);
  return test::complaints_about(parts);
}

TEST(CraneKeys, SayWhatIsWrongInADerating) {
  EXPECT_THAT(complaints_of_crane("derating: {source: maker, wind: [{up_to: 9 m/s, factor: 1}]}\n"),
              HasSubstr("no hoist has one"));
  const std::string from = "radius_from: {body: world, position: [0 m, 0 m, 0 m]}\n";
  const std::string chart = "    load_chart: [{radius: 6 m, capacity: 8 t}]\n";
  EXPECT_THAT(complaints_of_crane(from + "derating: {source: maker}\n", chart),
              HasSubstr("give wind, sea, or both"));
  EXPECT_THAT(
      complaints_of_crane(from + "derating: {source: maker, wind: [{up_to: 9 m/s, factor: 1}, "
                                 "{up_to: 8 m/s, factor: 0.5}]}\n",
                          chart),
      HasSubstr("wind table of the derating does not ascend: 8 comes after 9"));
  EXPECT_THAT(
      complaints_of_crane(from + "derating: {source: maker, sea: [{up_to: 1 m, factor: 0.5}, "
                                 "{up_to: 2 m, factor: 1}]}\n",
                          chart),
      HasSubstr("leaves more, 1, at 2 than before, 0.5"));
}

TEST(CraneKeys, SayWhatIsWrongInAReeving) {
  EXPECT_THAT(complaints_of_crane("", "    reeving: {falls: 9, lead_lines: 2}\n"),
              HasSubstr("9 falls cannot be shared evenly by 2 lead lines"));
  EXPECT_THAT(complaints_of_crane("", "    reeving: {falls: 0}\n"), HasSubstr("falls"));
  EXPECT_THAT(complaints_of_crane("", "    reeving: {falls: 8, sheave_efficiency: 30 %}\n"),
              HasSubstr("sheave_efficiency"));
}

TEST(CraneKeys, SayWhatIsWrong) {
  EXPECT_THAT(complaints_of_crane("", "    load_chart: [{radius: 6 m, capacity: 8 t}]\n"),
              HasSubstr("says not from where its radius counts"));
  EXPECT_THAT(
      complaints_of_crane("radius_from: {body: world, position: [0 m, 0 m, 0 m]}\n",
                          "    load_chart: [{radius: 6 m, capacity: 8 t}, {radius: 5 m, capacity: "
                          "9 t}]\n"),
      HasSubstr("do not ascend: 5 m comes after 6 m"));
  EXPECT_THAT(complaints_of_crane("radius_from: {body: gantri, position: [0 m, 0 m, 0 m]}\n"),
              HasSubstr("did you mean \"gantry\"?"));
  const std::string in_line =
      "{A: {position: [0 m, 0 m, 0 m]}, B: {position: [0 m, 5 m, 0 m]}, C: {position: [0 m, 9 m, 0 "
      "m]}}";
  EXPECT_THAT(complaints_of_crane("stands_on: {body: gantry, supports: " + in_line + "}\n"),
              HasSubstr("not in line"));
  EXPECT_THAT(complaints_of_crane("stands_on: {body: trolley, supports: " + in_line + "}\n"),
              HasSubstr("does not stand on the base"));
  EXPECT_THAT(complaints_of_crane(
                  "springs:\n  stay: {kind: point, from: {body: world, position: [0 m, 0 m, "
                  "20 m]}, to: {body: gantry, position: [0 m, 0 m, 10 m]}, stiffness: 1 "
                  "MN/m}\nstands_on: {body: gantry, supports: " +
                  in_line + "}\n"),
              HasSubstr("spring stay ties the crane to its base, too"));
}

// What the reader has said of a stand is not said once more of what it could not read.
TEST(CraneKeys, SayOnceWhatAStandLacks) {
  for (const char* const lines :
       {"stands_on: gantry\n", "stands_on: {body: gantry}\n",
        "stands_on: {body: gantry, supports: [{position: [0 m, 0 m, 0 m]}]}\n",
        "stands_on: {supports: {A: {position: [0 m, 0 m, 0 m]}, B: {position: [0 m, 5 m, 0 m]}, "
        "C: {position: [1 m, 9 m, 0 m]}}}\n"})
    EXPECT_THAT(complaints_of_crane(lines), ::testing::EndsWith("\n1 error\n")) << lines;
  EXPECT_THAT(complaints_of_crane("stands_on: {body: gantry, supports: {}}\n"),
              HasSubstr("three supports or more"));
}

}  // namespace
}  // namespace blocklift::pipeline
