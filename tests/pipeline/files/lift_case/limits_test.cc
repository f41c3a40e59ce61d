// Limits under checks ask for what they hold.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/files/lift_case/lift_case_complaints.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

test::SampleLift with_checks(const std::string& checks) {
  test::SampleLift lift;
  lift.lift_case =
      test::with(lift.lift_case, "settle: 10 s\n", "settle: 10 s\nchecks: {" + checks + "}\n");
  return lift;
}

TEST(Limits, OfWhatTheCaseLacksAreErrorsAtTheirPlaces) {
  EXPECT_EQ(test::complaints_about(with_checks("offlead: 3 deg, sidelead: 2 deg")),
            "case.yaml:21:19: error: checks has offlead, but no crane says from where its radius "
            "counts\n"
            "    give the crane a radius_from: {body: world, position: [0 m, 0 m, 0 m]}, or hold "
            "the tackles by swing\n"
            "case.yaml:21:36: error: checks has sidelead, but no crane says from where its radius "
            "counts\n"
            "    give the crane a radius_from: {body: world, position: [0 m, 0 m, 0 m]}, or hold "
            "the tackles by swing\n"
            "2 errors\n");
  EXPECT_THAT(test::complaints_about(with_checks("falls_twist: 60 deg")),
              HasSubstr("case.yaml:21:23: error: checks has falls_twist, but no crane has a hook "
                        "block that turns\n"));
  EXPECT_THAT(test::complaints_about(with_checks("heel: 5 deg")),
              HasSubstr("case.yaml:21:16: error: checks has heel, but the case has no vessels\n"));
  EXPECT_THAT(
      test::complaints_about(with_checks("freeboard: 1 m")),
      HasSubstr("case.yaml:21:21: error: checks has freeboard, but the case has no vessels\n"));
  EXPECT_THAT(test::complaints_about(with_checks("spreader_factor: 2")),
              HasSubstr("case.yaml:21:27: error: checks has spreader_factor, but the case has no "
                        "spreaders\n"));
}

TEST(Limits, OfWhatTheCaseHasAreTaken) {
  test::SampleLift lift = with_checks("offlead: 3 deg, sidelead: 2 deg, falls_twist: 60 deg");
  lift.crane =
      test::with(lift.crane, "capacity: 20 t\n",
                 "capacity: 20 t\nradius_from: {body: world, position: [0 m, 0 m, 0 m]}\n");
  lift.crane =
      test::with(lift.crane, "{mass: 500 kg}",
                 "{mass: 500 kg, turning: {falls_apart: 1.2 m, radius_of_gyration: 0.4 m}}");
  EXPECT_THAT(test::complaints_about(lift), IsEmpty());
}

// A crane that was not found is complained of alone.
TEST(Limits, OfACraneThatIsNotThereAreNotSpokenOf) {
  test::SampleLift lift = with_checks("offlead: 3 deg");
  lift.lift_case = test::with(lift.lift_case, "model: gantry", "model: gantri");
  EXPECT_THAT(test::complaints_about(lift), HasSubstr("1 error\n"));
}

}  // namespace
}  // namespace blocklift::pipeline
