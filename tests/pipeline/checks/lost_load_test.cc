// A load that hangs on nothing fails the lift, and so does one that goes into the ground.
#include "pipeline/checks/lost_load.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/checks/measure_checks.h"
#include "tests/pipeline/lift/operated_lift.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

constexpr double above_ground = 1.8;  // m, of the sample lift's load at the start

const std::string stay = "  - stage: hold\n    pause: 6 s\n";
const std::string ground_bears = "ground_contact: {stiffness: 5 MN/m, damping: 200 kN s/m}\n";

std::string with_faults(const std::string& list) { return "faults: [" + list + "]\n"; }

/// All checks of the sample lift with this operation whose name begins so.
struct SampleChecks {
  SampleChecks(const std::string& operation, const std::string& more) {
    const LiftCase lift_case = test::lift_with_operation(operation, more);
    const LiftRun run = test::run_sample(lift_case, {.natural_modes = false});
    checks = check_lift(lift_case, run);
    for (Check& check : check_measures(lift_case, run, find_measures(lift_case, run)))
      checks.push_back(std::move(check));
  }
  std::optional<Check> find(const std::string& beginning) const {
    for (const Check& check : checks)
      if (check.name.starts_with(beginning)) return check;
    return std::nullopt;
  }
  std::optional<Check> held() const { return find("all ropes of the load have parted"); }
  std::optional<Check> in_ground() const { return find("ground: how far"); }

  std::vector<Check> checks;
};

TEST(LostLoad, FailsWhenAllItsSlingsPart) {
  const SampleChecks lift(stay, with_faults("{at: 2 s, parts: [R1, R2]}"));
  const std::optional<Check> held = lift.held();
  ASSERT_TRUE(held);
  EXPECT_FALSE(held->pass);
  EXPECT_EQ(held->demand, 0);
  EXPECT_EQ(held->limit, 0.9);
  EXPECT_EQ(held->time, 2);
  EXPECT_THAT(held->note, HasSubstr("R1, R2 parted: the load falls "));
  // Nothing bears it, so that it goes into the ground besides.
  const std::optional<Check> in_ground = lift.in_ground();
  ASSERT_TRUE(in_ground);
  EXPECT_FALSE(in_ground->pass);
  EXPECT_GT(in_ground->demand, 100);
}

TEST(LostLoad, FailsWhenAllTacklesPart) {
  const SampleChecks lift(stay, with_faults("{at: 2 s, parts: [C1.left]}, {at: 3 s, parts: [R2]}"));
  ASSERT_TRUE(lift.held());
  EXPECT_FALSE(lift.held()->pass);
  EXPECT_EQ(lift.held()->time, 3);
  EXPECT_THAT(lift.held()->note, HasSubstr("C1.left, R2 parted: the load falls "));
}

// What hangs on the rest of its ropes is not lost.
TEST(LostLoad, IsNotOneThatHangsOnTheRest) {
  for (const char* part : {"R1", "C1.left"}) {
    const SampleChecks lift(stay, with_faults(std::string("{at: 2 s, parts: [") + part + "]}"));
    EXPECT_FALSE(lift.held()) << part;
  }
  const SampleChecks whole(stay, "");
  EXPECT_FALSE(whole.held());
  EXPECT_FALSE(whole.in_ground());
}

TEST(LostLoad, TellsHowItMeetsTheGround) {
  const SampleChecks lift(stay, ground_bears + with_faults("{at: 2 s, parts: [R1, R2]}"));
  ASSERT_TRUE(lift.held());
  EXPECT_FALSE(lift.held()->pass);
  // By the second sample behind 2 s + sqrt(2 h / g) = 2.61 s, with sqrt(2 g h) = 5.9 m/s.
  EXPECT_THAT(lift.held()->note, HasSubstr("m and meets the ground at 2.6"));
  EXPECT_THAT(lift.held()->note, HasSubstr(" with 5."));
  EXPECT_NEAR(std::sqrt(2 * 9.81 * above_ground), 5.9, 0.1);
  EXPECT_FALSE(lift.in_ground());
}

// Slings that part when the load has been set down leave it where it stands.
TEST(LostLoad, MayStandOnTheGround) {
  const SampleChecks lift(
      "  - stage: lower\n    moves: [{drives: [C1.left, C1.right], by: 2.5 m}]\n",
      ground_bears + with_faults("{at: 34 s, parts: [R1, R2]}"));
  const std::optional<Check> held = lift.held();
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->pass) << held->note;
  EXPECT_NEAR(held->demand, 1, 0.05);
  EXPECT_THAT(held->note, HasSubstr("R1, R2 parted: the load stands or floats"));
}

TEST(GroundCheck, FailsWhereNothingBearsTheLoad) {
  const std::string lower =
      "  - stage: lower\n    moves: [{drives: [C1.left, C1.right], by: 2.5 m}]\n";
  const SampleChecks lift(lower, "");
  const std::optional<Check> in_ground = lift.in_ground();
  ASSERT_TRUE(in_ground);
  EXPECT_FALSE(in_ground->pass);
  EXPECT_NEAR(in_ground->demand, 2.5 - above_ground, 0.1);
  EXPECT_EQ(in_ground->note, "ground at z = 0 m");
  EXPECT_FALSE(lift.held());
  // Where the case says that the ground lies lower, or that it bears, it does not fail.
  EXPECT_FALSE(SampleChecks(lower, "ground: -2 m\n").in_ground());
  EXPECT_FALSE(SampleChecks(lower, ground_bears).in_ground());
}

}  // namespace
}  // namespace blocklift::pipeline
