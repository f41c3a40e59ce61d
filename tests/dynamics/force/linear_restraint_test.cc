// A restraint by matrices: its law at small motions, its energy at large ones, and natural modes,
// offset and decay of a body that it alone holds, in closed form.
#include "dynamics/force/linear_restraint.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using Matrix6 = LinearRestraint::Matrix6;
using Vector6 = LinearRestraint::Vector6;
using examples::Random;
using test::OneBody;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Matrix6 full_matrix(Random& random) {
  Matrix6 matrix;
  for (int column = 0; column < 6; ++column) matrix.col(column) = random.values(6, 10);
  return matrix;
}

LinearRestraint::Definition symmetric_restraint(Random& random) {
  const Matrix6 K = full_matrix(random), C = full_matrix(random);
  return {.name = "r",
          .point = {1, random.vector(1)},
          .X_WR = random.pose(1),
          .stiffness = K + K.transpose(),
          .damping = C * C.transpose() + 5.0 * (K - K.transpose())};
}

TEST(LinearRestraint, IsTheMatricesAtSmallMotions) {
  Random random(11);
  const LinearRestraint restraint(symmetric_restraint(random));
  const LinearRestraint::Definition& d = restraint.definition();
  OneBody body;
  const Matrix3 R = d.X_WR.R;
  const Vector6 x = 1e-6 * random.values(6, 1), V = 1e-6 * random.values(6, 1);
  const Matrix3 R_WB = R * rotation_from_quaternion(quaternion_exponential(x.head<3>()));
  const Vector3 arm = R_WB * d.point.p_BoQ_B;
  body.q << d.X_WR.p + R * x.tail<3>() - arm, quaternion_from_rotation(R_WB);
  // Velocities of a free joint: of Bo in the world, and of turning in the body's axes.
  body.update();
  body.v.setZero();
  Eigen::MatrixXd by_velocity(6, 6);
  for (int k = 0; k < 6; ++k) {
    body.v = Eigen::VectorXd::Unit(6, k);
    body.update();
    const MotionVector V_P = shift(body.kinematics.V_WB[1], arm);
    by_velocity.col(k) << R.transpose() * V_P.angular, R.transpose() * V_P.linear;
  }
  body.v = by_velocity.fullPivLu().solve(V);
  body.update();
  body.loads.set_zero();
  restraint.add_forces(body.state(), body.loads);
  const ForceVector& F = body.loads.F_Bo_W[1];
  Vector6 about_P;
  about_P << R.transpose() * (F.moment - arm.cross(F.force)), R.transpose() * F.force;
  const Vector6 due = -d.stiffness * x - d.damping * V;
  EXPECT_LT((about_P - due).norm(), 1e-5 * due.norm());
}

TEST(LinearRestraint, BalancesAtMotionsOfAnySize) {
  Random random(12);
  OneBody body;
  for (int i = 0; i < 20; ++i) {
    LinearRestraint::Definition definition = symmetric_restraint(random);
    if (i % 2 == 1) definition.stiffness(1, 4) += 20.0;
    const LinearRestraint restraint(definition);
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.update();
    test::expect_balanced(body, restraint);
    const EnergyAccount account = restraint.calc_energy(body.state());
    EXPECT_GT(account.dissipated_power, 0.0);
    if (i % 2 == 0) {
      EXPECT_EQ(account.supplied_power, 0.0);
    } else {
      EXPECT_GT(std::abs(account.supplied_power), 1e-3);
    }
  }
}

TEST(LinearRestraint, RefusesWhatCannotBe) {
  LinearRestraint::Definition d{.name = "r9", .point = {1, Vector3::Zero()}, .X_WR = {}};
  d.damping(3, 3) = 4.0;
  d.damping(4, 4) = 9.0;
  d.damping(3, 4) = d.damping(4, 3) = 5.9;
  EXPECT_NO_THROW(LinearRestraint{d});
  d.damping(3, 4) = d.damping(4, 3) = 6.1;
  EXPECT_THAT([&] { LinearRestraint{d}; },
              ThrowsMessage<ModelError>(HasSubstr("\"r9\" has a damping that adds energy")));
  d.damping.setZero();
  d.stiffness(0, 0) = not_a_number;
  EXPECT_THAT([&] { LinearRestraint{d}; }, ThrowsMessage<ModelError>(HasSubstr("not finite")));
  d.stiffness.setZero();
  d.point.body = world_index;
  EXPECT_THAT([&] { LinearRestraint{d}; },
              ThrowsMessage<ModelError>(HasSubstr("holds no body that moves")));
}

// A body of 3 kg and 2 kg m2 about y, whose surge and pitch are coupled.
constexpr double held_mass = 3.0, held_inertia = 2.0, k11 = 40.0, k15 = -12.0, k55 = 30.0;

LiftSystem held_body(const Matrix6& damping, const Vector3& force, double duration) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body({.name = "body",
                    .joint = {.kind = JointKind::free},
                    .mass = held_mass,
                    .I_BBcm_B = Vector3(1.5, held_inertia, 1.0).asDiagonal()});
  LinearRestraint::Definition d{.name = "r", .point = {1, Vector3::Zero()}, .X_WR = {}};
  d.X_WR = Pose::identity();
  d.stiffness.diagonal() << 60, k55, 70, k11, 50, 90;
  d.stiffness(3, 1) = d.stiffness(1, 3) = k15;
  d.damping = damping;
  ForceElements elements;
  std::get<std::vector<LinearRestraint>>(elements).emplace_back(d);
  std::get<std::vector<AppliedLoad>>(elements).emplace_back(AppliedLoad::Definition{
      .name = "f", .point = {1, Vector3::Zero()}, .force = LoadTable(force)});
  Mechanism mechanism = builder.build();
  const Eigen::VectorXd q = mechanism.zero_configuration();
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = {},
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(duration),
                     .q_start = q,
                     .v_start = {}});
}

bool has_frequency(const Linearisation& l, double omega, double ratio) {
  for (const Mode& mode : l.modes) {
    if (std::abs(mode.natural_frequency() / omega - 1.0) < 1e-7 &&
        std::abs(mode.damping_ratio() - ratio) < 1e-7) {
      return true;
    }
  }
  return false;
}

TEST(LinearRestraint, CoupledModesAreThoseOfTwoFreedoms) {
  Matrix6 damping = Matrix6::Zero();
  damping(5, 5) = 2.5;
  const LiftSystem system = held_body(damping, Vector3::Zero(), 1.0);
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const Linearisation l = linearise(system, 0.0, solver.workspace());
  ASSERT_EQ(l.modes.size(), 6U);
  // m I w^4 - (m k55 + I k11) w^2 + k11 k55 - k15^2 = 0.
  const double middle = held_mass * k55 + held_inertia * k11;
  const double root =
      std::sqrt(middle * middle - 4.0 * held_mass * held_inertia * (k11 * k55 - k15 * k15));
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(has_frequency(
        l, std::sqrt((middle + sign * root) / (2.0 * held_mass * held_inertia)), 0.0));
  }
  const double heave = std::sqrt(90.0 / held_mass);
  EXPECT_TRUE(has_frequency(l, heave, 2.5 / (2.0 * held_mass * heave)));
  EXPECT_TRUE(has_frequency(l, std::sqrt(60.0 / 1.5), 0.0));
}

TEST(LinearRestraint, OffsetIsForceOverStiffness) {
  const LiftSystem system = held_body(Matrix6::Zero(), {2e-4, 0, 9.0}, 1.0);
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const double determinant = k11 * k55 - k15 * k15;
  EXPECT_NEAR(q[2], 9.0 / 90.0, 1e-9);
  EXPECT_NEAR(q[0], 2e-4 * k55 / determinant, 1e-11);
  EXPECT_NEAR(2.0 * q[5], -2e-4 * k15 / determinant, 1e-11);  // of the quaternion
}

TEST(LinearRestraint, DecaysAsOneFreedomWithItsEnergyAccountedFor) {
  Matrix6 damping = Matrix6::Zero();
  damping(5, 5) = 2.5;
  const LiftSystem system = held_body(damping, Vector3::Zero(), 5.0);
  Eigen::VectorXd q = system.q_start();
  q[2] = 1.0;
  const IntegrationResult result =
      integrate(system, q, Eigen::VectorXd::Zero(6), {.relative_tolerance = 1e-10});
  const double decay = 2.5 / (2.0 * held_mass), omega = std::sqrt(90.0 / held_mass - decay * decay);
  const double due =
      std::exp(-decay * 5.0) * (std::cos(omega * 5.0) + decay / omega * std::sin(omega * 5.0));
  EXPECT_NEAR(result.q_end[2], due, 1e-7);
  const EnergyHistory& energy = result.history.energy;
  const Eigen::VectorXd sum = energy.kinetic + energy.elastic + energy.dissipated;
  EXPECT_NEAR(sum[0], 45.0, 1e-9);
  EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), 1e-6 * 45.0);
  EXPECT_GT(energy.dissipated[sum.size() - 1], 40.0);
}

}  // namespace
}  // namespace blocklift::dynamics
