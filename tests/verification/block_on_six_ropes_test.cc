// An 860 t block on six ropes, hoisted for 120 s: centre of mass at the end against an independent
// computation (Simbody at the accuracy 1e-12), given to 1e-6 m.
#include <gtest/gtest.h>

#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

TEST(BlockOnSixRopes, PositionAfterTheHoist) {
  const LiftSystem lift = samples::block_on_six_ropes();
  const Vector3 reference(-0.000643, -0.001888, 5.913927);
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 1.0});
  // Half a unit of the reference's last digit.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(run.q_end[axis], reference[axis], 0.5e-6) << "axis " << axis;
  }
  // The block's weight is 8.4 MN and 50 MJ are spent: what is left over is the quadrature's error.
  const EnergyHistory& e = run.history.energy;
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.winch_work - e.dissipated;
  EXPECT_GT(e.winch_work[e.winch_work.size() - 1], 49e6);
  EXPECT_LT((energy - energy[0] - work).abs().maxCoeff(), 1e-9 * 50e6);
}

// The error is asked for by the tolerance alone: at the tolerance of everyday use it is below
// 0.01 mm, and the order of steps stays in the thousands.
TEST(BlockOnSixRopes, AccuracyAndCostAtTheEverydayTolerance) {
  const LiftSystem lift = samples::block_on_six_ropes();
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-6, .sample_interval = 1.0});
  EXPECT_LT((run.q_end.head<3>() - Vector3(-0.000643, -0.001888, 5.913927)).norm(), 1e-5);
  EXPECT_LT(run.statistics.right_hand_sides, 8000);
  EXPECT_EQ(run.statistics.contact_changes, 0);
}

}  // namespace
}  // namespace blocklift::dynamics
