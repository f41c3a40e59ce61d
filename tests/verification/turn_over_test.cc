// The whole turn-over with two goliath cranes: what must hold whatever the numbers are.
#include <gtest/gtest.h>

#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

TEST(TurnOver, EnergyNewtonAndStaticLoads) {
  const LiftSystem lift = test::two_goliaths();
  const double duration = lift.operation().duration();
  const History statics = static_sweep(lift, sample_times(duration, 1.0), lift.q_start());
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  const IntegrationResult run =
      integrate(lift, q, lift.v_start(), {.relative_tolerance = 1e-7, .sample_interval = 0.1});
  const History& history = run.history;

  // Energy to 1e-7 of what the winches give.
  const EnergyHistory& e = history.energy;
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work + e.outside_work - e.dissipated;
  EXPECT_GT(e.winch_work.maxCoeff(), 50e6);
  EXPECT_LT((energy - energy[0] - work).abs().maxCoeff(), 1e-6 * e.winch_work.maxCoeff());

  // At the start both are one and the same equilibrium.
  for (std::size_t i = 0; i < history.ropes.size(); ++i) {
    EXPECT_NEAR(history.ropes[i].tension[0], statics.ropes[i].tension[0], 1.0);
  }
  // Loads swing about the static ones; the largest exceeds the largest static one.
  const std::vector<LinkedMaximum> largest_static = find_largest_tensions(statics);
  const std::vector<LinkedMaximum> largest_dynamic = find_largest_tensions(history);
  for (std::size_t i = 0; i < history.ropes.size(); ++i) {
    EXPECT_GT(largest_dynamic[i].tension, largest_static[i].tension);
    EXPECT_LT(largest_dynamic[i].tension, 1.1 * largest_static[i].tension);
  }
}

}  // namespace
}  // namespace blocklift::dynamics
