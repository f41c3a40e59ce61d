// Runs that leave out what nobody asks for.
#include <gtest/gtest.h>

#include "tests/pipeline/lift/operated_lift.h"

namespace blocklift::pipeline {
namespace {

using test::run_sample;

TEST(RunExtent, LeavesTheMotionAsItIs) {
  const test::TemporaryFolder folder;
  test::SampleLift().write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  const LiftRun whole = run_sample(lift_case);
  const LiftRun least =
      run_sample(lift_case, {.natural_modes = false, .energy = false, .righting_height = false});
  EXPECT_EQ(least.dynamic_history().time, whole.dynamic_history().time);
  ASSERT_EQ(least.dynamic_history().ropes.size(), whole.dynamic_history().ropes.size());
  for (std::size_t i = 0; i < whole.dynamic_history().ropes.size(); ++i) {
    EXPECT_EQ(least.static_history.ropes[i].tension, whole.static_history.ropes[i].tension);
    EXPECT_EQ(least.dynamic_history().ropes[i].tension, whole.dynamic_history().ropes[i].tension);
  }
  EXPECT_EQ(least.dynamic_result.q_end, whole.dynamic_result.q_end);
  EXPECT_EQ(least.dynamic_result.statistics.steps, whole.dynamic_result.statistics.steps);

  EXPECT_FALSE(whole.natural_modes.empty());
  EXPECT_TRUE(least.natural_modes.empty());
  EXPECT_EQ(whole.dynamic_history().energy.winch_work.size(), whole.dynamic_history().time.size());
  EXPECT_EQ(least.dynamic_history().energy.winch_work.size(), 0);
  EXPECT_EQ(least.dynamic_history().energy.kinetic.size(), 0);
  EXPECT_FALSE(whole.righting_height.hasNaN());
  EXPECT_TRUE(least.righting_height.array().isNaN().all());
}

TEST(RunExtent, MayBeTheTensionsAlone) {
  const test::TemporaryFolder folder;
  test::SampleLift().write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  const LiftRun whole = run_sample(lift_case);
  const LiftRun least = run_sample(lift_case, RunExtent::tensions());
  for (std::size_t i = 0; i < whole.dynamic_history().ropes.size(); ++i)
    EXPECT_EQ(least.dynamic_history().ropes[i].tension, whole.dynamic_history().ropes[i].tension);
  EXPECT_TRUE(whole.is_swept());
  EXPECT_FALSE(least.is_swept());
  EXPECT_EQ(least.dynamic_history().bodies[0].pose.rows(), 0);
  RunExtent impossible = RunExtent::tensions();
  impossible.natural_modes = true;
  EXPECT_THROW(run_sample(lift_case, impossible), std::invalid_argument);
}

}  // namespace
}  // namespace blocklift::pipeline
