// The right-hand side as a whole, and that it allocates nothing (see allocation_counter.h).
#include "dynamics/simulation/lift_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/energy_ledger.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using blocklift::test::allocations;
using blocklift::test::counts_allocations;

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(LiftSystem, RightHandSideOfTheTwoGoliathsAllocatesNothing) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  const LiftSystem lift = test::two_goliaths();
  LiftWorkspace w(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  Eigen::VectorXd indicators(lift.contact_count());
  get_state(lift, lift.q_start(), lift.v_start(), y);
  const Contacts contacts = find_contacts(lift, 0.0, y, w);
  EXPECT_EQ(lift.nv_free(), 24);
  EXPECT_EQ(lift.ropes().size(), 12u);
  const long before = allocations();
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    calc_right_hand_side(lift, 10.0 * i, y, &contacts, w, ydot);
    calc_contact_indicators(w, indicators);
    sum += calc_energy_rates(lift, 10.0 * i, w).winch_power;
    sum += calc_stored_energy(lift, 10.0 * i, w).sum();
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

// Steps cost no memory: ten times as many allocate no more.
TEST(LiftSystem, IntegrationAllocatesNothingPerStep) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  const LiftSystem lift = examples::SingleRopeLift{.duration = 20.0}.build();
  const auto count = [&](double tolerance) {
    const long before = allocations();
    const IntegrationResult run =
        integrate(lift, Vector3(1, 0, -20.05), lift.v_start(),
                  {.relative_tolerance = tolerance, .sample_interval = 1.0});
    return std::pair(allocations() - before, run.statistics.steps);
  };
  const auto coarse = count(1e-4);
  const auto fine = count(1e-10);
  EXPECT_GT(fine.second, 3 * coarse.second);
  // Events are stored as they come, so their list may grow a few times.
  EXPECT_LE(fine.first, coarse.first + 8);
}

// From the first sample after the start to the last nothing is allocated at all, by SUNDIALS
// neither: the 860 t block hoisted on six ropes, works included, over 1,000 steps and the
// breakpoints of its winches.
TEST(LiftSystem, NothingIsAllocatedBetweenTheFirstSampleAndTheLast) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  const LiftSystem lift = examples::block_on_six_ropes();
  long at_first = 0, at_last = 0;
  const auto observe = [&](Eigen::Index sample, double, const LiftWorkspace&) {
    (sample <= 1 ? at_first : at_last) = allocations();
  };
  const IntegrationResult run =
      integrate(lift, lift.q_start(), lift.v_start(),
                {.relative_tolerance = 1e-5, .sample_interval = 1.0, .observe = observe});
  EXPECT_GT(run.statistics.steps, 1000);
  EXPECT_EQ(at_last, at_first);
}

TEST(LiftSystem, JudgesAContactAtItsChangeByWhereItGoes) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  LiftWorkspace w(lift);
  const auto taut = [&](double z, double speed) {
    Eigen::VectorXd y(6);
    y << 0, 0, z, 0, 0, speed;
    return find_contacts(lift, 0.0, y, w)[0] != 0;
  };
  EXPECT_TRUE(taut(-20.1, 0.0));
  EXPECT_FALSE(taut(-19.9, 0.0));
  EXPECT_TRUE(taut(-20.0, -1.0));  // stretches
  EXPECT_FALSE(taut(-20.0, 1.0));  // rises
  EXPECT_TRUE(taut(-20.0, 0.0));   // falls
}

// A spring at a driven joint is the drive's to overcome.
TEST(LiftSystem, DriveForceHoldsTheSpringAtItsJoint) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -10});
  builder.add_body({.name = "trolley",
                    .joint = {.kind = JointKind::prismatic, .axis = Vector3::UnitZ()},
                    .mass = 2.0,
                    .driven = {true}});
  Mechanism mechanism = builder.build();
  ForceElements elements;
  std::get<std::vector<JointSpring>>(elements).emplace_back(
      mechanism,
      JointSpring::Definition{.name = "s", .body = 1, .stiffness = 5.0, .free_coordinate = 0.0});
  OperationBuilder operation;
  operation.add_joint_drive(mechanism, "drive", 1, 3.0);
  const Operation built = operation.build(1.0);
  const LiftSystem lift({.mechanism = mechanism,
                         .ropes = {},
                         .supports = {},
                         .elements = elements,
                         .operation = built,
                         .q_start = Eigen::VectorXd::Zero(1),
                         .v_start = {}});
  LiftWorkspace w(lift);
  Eigen::VectorXd empty(0);
  calc_right_hand_side(lift, 0.0, empty, nullptr, w, empty);
  EXPECT_NEAR(w.joint_force[0], 20.0 + 15.0, 1e-12);
  const History sweep = static_sweep(lift, sample_times(1.0, 0.5), lift.q_start());
  EXPECT_NEAR(sweep.drives[0].force[0], 35.0, 1e-12);
}

// A free body led along a screw: where it is in closed form, and the drives' work is its energy.
TEST(LiftSystem, WholeJointFollowsADirection) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -10});
  builder.add_body({.name = "body",
                    .joint = {.kind = JointKind::free},
                    .mass = 2.0,
                    .p_BoBcm_B = {0.1, 0.2, 0.3},
                    .I_BBcm_B = Vector3(1, 2, 2.5).asDiagonal(),
                    .driven = std::vector<bool>(6, true)});
  const Mechanism mechanism = builder.build();
  OperationBuilder operation;
  const Eigen::VectorXd q0 = mechanism.zero_configuration();
  Eigen::VectorXd screw(6);
  screw << 0, 0, 1, 0, 0, 0.5;
  operation.add_direction_drive(mechanism, "turner", 1, q0, screw);
  operation.add_move("turner", {1.0, 2.0, {1, 1, 1}});
  const Operation built = operation.build(10.0);
  const LiftSystem lift({.mechanism = mechanism, .operation = built, .q_start = q0});
  const IntegrationResult run = integrate(lift, q0, lift.v_start(), {.relative_tolerance = 1e-9});
  const BodyHistory& body = run.history.body("body");
  const Eigen::Index last = run.history.sample_count() - 1;
  EXPECT_LT((body.X_WB(last).R - rotation_about(Vector3::UnitZ(), 2.0)).norm(), 1e-12);
  EXPECT_LT((body.X_WB(last).p - Vector3(0, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(run.history.drives[5].name, "turner 6");
  EXPECT_NEAR(run.history.drives[5].force[last], 20.0, 1e-10);
  EXPECT_NEAR(run.history.energy.drive_work[last], 20.0, 1e-6);
}

TEST(LiftSystem, RefusesWhatDoesNotFit) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  EXPECT_THAT([&] { lift.rope_index("sling"); },
              ThrowsMessage<ModelError>(HasSubstr("the ropes are rope")));
  EXPECT_THAT(
      [&] {
        LiftSystem({.mechanism = lift.mechanism(),
                    .ropes = {},
                    .supports = {},
                    .elements = {},
                    .operation = OperationBuilder().build(1.0),
                    .q_start = Eigen::VectorXd::Zero(2),
                    .v_start = {}});
      },
      ThrowsMessage<ModelError>(HasSubstr("starts from 2 coordinates")));
}

}  // namespace
}  // namespace blocklift::dynamics
