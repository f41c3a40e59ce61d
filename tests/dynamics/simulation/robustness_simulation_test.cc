// Equilibrium and time integration where a pose is singular, and from quaternions of any length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A load on three axes through two rings without mass, its centre below them.
LiftSystem gimbal(const Vector3& q, const Vector3& v, double duration) {
  MechanismBuilder builder;
  builder.add_body({.name = "outer", .joint = {JointKind::revolute, Vector3::UnitX()}, .mass = 0});
  builder.add_body({.name = "inner",
                    .parent = "outer",
                    .joint = {JointKind::revolute, Vector3::UnitY()},
                    .mass = 0});
  builder.add_body({.name = "load",
                    .parent = "inner",
                    .joint = {JointKind::revolute, Vector3::UnitZ()},
                    .mass = 3,
                    .p_BoBcm_B = {0, 0, -0.8},
                    .I_BBcm_B = Vector3(0.4, 0.5, 0.3).asDiagonal()});
  return LiftSystem({.mechanism = builder.build(),
                     .operation = OperationBuilder().build(duration),
                     .q_start = q,
                     .v_start = v});
}

template <class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

TEST(SingularPose, IntegrationThatStartsInItNamesTheBody) {
  const LiftSystem lift = gimbal({0, M_PI_2, 0}, {0, 0, 0}, 1.0);
  EXPECT_THAT(message_of([&] { integrate(lift, lift.q_start(), lift.v_start()); }),
              AllOf(HasSubstr("\"outer\" (revolute)"), HasSubstr("nothing resists this motion")));
}

// Swinging about y alone the load runs right through the pose at 90 degrees. Where a step's end
// does not happen to fall on it, the motion goes on as that of a pendulum; where it does, the body
// is named. Never NaN.
TEST(SingularPose, IntegrationThroughItIsFiniteOrNamesTheBody) {
  const LiftSystem lift = gimbal({0, 1.2, 0}, {0, 5, 0}, 0.5);
  IntegrationResult run{History(lift, 0, false), {}, {}, {}, {}};
  const std::string message =
      message_of([&] { run = integrate(lift, lift.q_start(), lift.v_start()); });
  if (message.empty()) {
    EXPECT_TRUE(run.q_end.allFinite());
    EXPECT_GT(run.q_end[1], M_PI_2);
  } else {
    EXPECT_THAT(message, HasSubstr("\"outer\" (revolute)"));
  }
}

TEST(SingularPose, EquilibriumOfAMotionThatNothingResistsNamesTheBody) {
  MechanismBuilder builder;
  builder.add_body(
      {.name = "bob", .joint = {JointKind::spherical}, .mass = 2, .p_BoBcm_B = {0, 0, -1}});
  const LiftSystem lift({.mechanism = builder.build(),
                         .operation = OperationBuilder().build(1.0),
                         .q_start = Vector4(0.9, 0.1, 0, 0)});
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  EXPECT_THAT(message_of([&] { solver.solve(0.0, q); }),
              AllOf(HasSubstr("\"bob\" (spherical, velocity 3 of 3, turning)"),
                    HasSubstr("nothing resists this motion")));
}

TEST(LinkWithoutMass, HangsAndSwings) {
  const LiftSystem lift = gimbal({0.2, 0.3, 0.1}, {0, 0, 0}, 1.0);
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  EXPECT_LT(q.head<2>().norm(), 1e-9);
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.1});
  const EnergyHistory& e = run.history.energy;
  const Eigen::ArrayXd sum = e.kinetic + e.gravity;
  EXPECT_LT((sum - sum[0]).abs().maxCoeff(), 1e-7 * 3 * 9.81 * 0.8);
}

// The six-rope lift from a quaternion five times as long, and of the other sign.
TEST(Quaternion, LengthAtTheStartDoesNotMatter) {
  const LiftSystem lift = examples::block_on_six_ropes();
  const IntegrationSettings settings{.relative_tolerance = 1e-5, .sample_interval = 10.0};
  Eigen::VectorXd q = lift.q_start();
  const Eigen::VectorXd reference = integrate(lift, q, lift.v_start(), settings).q_end;
  q.tail<4>() *= -5.0;
  Eigen::VectorXd end = integrate(lift, q, lift.v_start(), settings).q_end;
  EXPECT_NEAR(end.tail<4>().norm(), 1.0, 1e-12);
  end.tail<4>() *= -1.0;
  // The error weights of the two runs differ by nothing, so that neither do the steps.
  EXPECT_LT((end - reference).norm(), 1e-9);
  EquilibriumSolver solver(lift);
  solver.solve(0.0, q);
  EXPECT_NEAR(q.tail<4>().norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace blocklift::dynamics
