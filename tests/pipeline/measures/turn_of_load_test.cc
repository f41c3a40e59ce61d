// The turn of a load about the plumb, counted from sample to sample.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/measures/load_measures.h"
#include "tests/pipeline/lift/operated_lift.h"

namespace blocklift::pipeline {
namespace {

LiftRun sample_run() {
  const test::TemporaryFolder folder;
  test::SampleLift().write(folder);
  return test::run_sample(read_lift_case("case.yaml"));
}

// A crane that slews by two turns takes its load along: the turn is not that but for whole turns.
TEST(TurnOfLoad, CountsWholeTurns) {
  LiftRun lift = sample_run();
  for (const double step : {2.0, -0.7}) {  // rad from sample to sample, less than half a turn
    auto& pose = lift.static_history.bodies[lift.model.load - 1].pose;
    for (Eigen::Index i = 0; i < pose.rows(); ++i) {
      const double half = 0.5 * step * static_cast<double>(i);
      pose.row(i).tail<4>() << std::cos(half), 0, 0, std::sin(half);
    }
    const LiftMeasure turn = turn_of_load(lift);
    ASSERT_GT(turn.at_rest.size(), 3);
    for (Eigen::Index i = 0; i < turn.at_rest.size(); ++i)
      EXPECT_NEAR(turn.at_rest[i], step * static_cast<double>(i), 1e-9) << i;
  }
}

// A load that is turned over by 200 degrees about an axis that is level to a thousandth: at 180 its
// turn about the plumb leaps by a whole turn, which it has not made.
TEST(TurnOfLoad, CountsNoTurnOfALoadThatIsTurnedOver) {
  LiftRun lift = sample_run();
  auto& pose = lift.static_history.bodies[lift.model.load - 1].pose;
  const double step = 200 * std::numbers::pi / 180 / static_cast<double>(pose.rows() - 1);
  for (Eigen::Index i = 0; i < pose.rows(); ++i) {
    const double half = 0.5 * step * static_cast<double>(i);
    pose.row(i).tail<4>() << std::cos(half), std::sin(half), 0, 1e-3 * std::sin(half);
    pose.row(i).tail<4>().normalize();
  }
  const LiftMeasure turn = turn_of_load(lift);
  ASSERT_GT(turn.at_rest.size(), 3);
  // Half the turn about the plumb has the tangent z/w = 1e-3 tan 100 degrees.
  EXPECT_NEAR(turn.at_rest[turn.at_rest.size() - 1], 2e-3 * std::tan(100 * std::numbers::pi / 180),
              1e-6);
}

}  // namespace
}  // namespace blocklift::pipeline
