// Histories that leave out what nobody asks for. What they hold is the same bit for bit: the same
// operations in the same order, so that nothing is tolerated.
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "tests/dynamics/simulation/sample_lifts.h"
#include "tests/dynamics/simulation/sample_mechanisms.h"

namespace blocklift::dynamics {
namespace {

constexpr Recording motion_alone{
    .motion = true, .rope_forces = false, .accelerations = false, .energy = false};

IntegrationResult run(const LiftSystem& lift, const Eigen::VectorXd& q,
                      const IntegrationSettings& settings) {
  return integrate(lift, q, lift.v_start(), settings);
}

void expect_same_ropes(const History& part, const History& whole) {
  EXPECT_EQ(part.time, whole.time);
  ASSERT_EQ(part.ropes.size(), whole.ropes.size());
  for (std::size_t i = 0; i < whole.ropes.size(); ++i) {
    EXPECT_EQ(part.ropes[i].tension, whole.ropes[i].tension) << whole.ropes[i].name;
    EXPECT_EQ(part.ropes[i].elongation, whole.ropes[i].elongation);
    EXPECT_EQ(part.ropes[i].unstretched_length, whole.ropes[i].unstretched_length);
    EXPECT_EQ(part.ropes[i].unstretched_rate, whole.ropes[i].unstretched_rate);
  }
}

void expect_same_motion(const History& part, const History& whole) {
  ASSERT_EQ(part.bodies.size(), whole.bodies.size());
  for (std::size_t i = 0; i < whole.bodies.size(); ++i) {
    EXPECT_EQ(part.bodies[i].pose, whole.bodies[i].pose) << whole.bodies[i].name;
    EXPECT_EQ(part.bodies[i].velocity, whole.bodies[i].velocity) << whole.bodies[i].name;
  }
}

// Two cranes hoist and travel: from the beginning of the operation to the end of its second stage.
TEST(Recording, LeavesTheRestOfATurnOverAsItIs) {
  const LiftSystem lift = test::two_goliaths();
  Eigen::VectorXd q = lift.q_start();
  EquilibriumSolver(lift).solve(0.0, q);
  IntegrationSettings settings;
  settings.end = lift.operation().stages()[1].end;
  const IntegrationResult whole = run(lift, q, settings);

  settings.works = false;
  settings.recording = Recording::tensions();
  const IntegrationResult least = run(lift, q, settings);
  expect_same_ropes(least.history, whole.history);
  EXPECT_EQ(least.q_end, whole.q_end);
  EXPECT_EQ(least.v_end, whole.v_end);
  EXPECT_EQ(least.statistics.steps, whole.statistics.steps);
  EXPECT_EQ(least.history.bodies[0].pose.rows(), 0);
  EXPECT_EQ(least.history.bodies[0].load.rows(), 0);
  EXPECT_EQ(least.history.ropes[0].first_force.rows(), 0);
  EXPECT_EQ(least.history.drives[0].position.size(), 0);
  EXPECT_EQ(least.history.energy.kinetic.size(), 0);

  settings.recording = {.energy = false};
  const IntegrationResult most = run(lift, q, settings);
  expect_same_ropes(most.history, whole.history);
  expect_same_motion(most.history, whole.history);
  for (std::size_t i = 0; i < whole.history.bodies.size(); ++i) {
    EXPECT_EQ(most.history.bodies[i].acceleration, whole.history.bodies[i].acceleration);
    EXPECT_EQ(most.history.bodies[i].load, whole.history.bodies[i].load);
  }
  for (std::size_t i = 0; i < whole.history.ropes.size(); ++i) {
    EXPECT_EQ(most.history.ropes[i].first_force, whole.history.ropes[i].first_force);
    EXPECT_EQ(most.history.ropes[i].last_force, whole.history.ropes[i].last_force);
  }
  for (std::size_t i = 0; i < whole.history.drives.size(); ++i)
    EXPECT_EQ(most.history.drives[i].force, whole.history.drives[i].force);

  settings.works = true;
  settings.recording = {.motion = false, .rope_forces = false, .accelerations = false};
  const EnergyHistory energy = run(lift, q, settings).history.energy;
  EXPECT_EQ(energy.kinetic, whole.history.energy.kinetic);
  EXPECT_EQ(energy.elastic, whole.history.energy.elastic);
  EXPECT_EQ(energy.winch_work, whole.history.energy.winch_work);
  EXPECT_EQ(energy.dissipated, whole.history.energy.dissipated);
}

TEST(Recording, LeavesEquilibriaAsTheyAre) {
  const LiftSystem lift = test::two_goliaths();
  const Eigen::VectorXd times = sample_times(20.0, 5.0);
  const History whole = static_sweep(lift, times, lift.q_start());
  const History least =
      static_sweep(lift, times, lift.q_start(), {}, {}, {}, Recording::tensions());
  expect_same_ropes(least, whole);
  EXPECT_EQ(least.bodies[0].pose.rows(), 0);
}

// Samples lie on the loops, whether their multipliers are found or not.
TEST(Recording, LeavesTheMotionOfLoopsAsItIs) {
  const LiftSystem system = test::andrews(LoopKind::revolute);
  IntegrationSettings settings{.sample_interval = 1e-3, .works = false};
  const IntegrationResult whole = run(system, system.q_start(), settings);
  settings.recording = motion_alone;
  const IntegrationResult part = run(system, system.q_start(), settings);
  expect_same_motion(part.history, whole.history);
  EXPECT_EQ(part.q_end, whole.q_end);
  EXPECT_EQ(part.history.loops[0].multipliers.rows(), 0);
}

TEST(Recording, HasNoWorksWithoutEnergies) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  IntegrationSettings settings;
  settings.recording.energy = false;
  EXPECT_THROW(run(lift, lift.q_start(), settings), ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
