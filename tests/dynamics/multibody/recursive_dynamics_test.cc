// The recursive algorithms check one another on random trees with every kind of joint, and
// kinematics are checked against finite differences, so that no shared formula can hide an error.
#include <gtest/gtest.h>

#include "dynamics/multibody/energy.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

// A random tree in a random state.
struct MovingTree {
  explicit MovingTree(unsigned seed, bool with_drives = false)
      : random(seed),
        mechanism(examples::random_tree(random, 12, with_drives)),
        q(examples::random_configuration(random, mechanism)),
        v(random.values(mechanism.nv(), 2)),
        forces(examples::random_forces(random, mechanism)),
        kinematics(mechanism) {
    compute_kinematics(mechanism, q, v, kinematics);
  }

  Eigen::VectorXd inverse(const Eigen::VectorXd& vdot) const {
    InverseDynamicsWorkspace workspace(mechanism);
    Eigen::VectorXd tau(mechanism.nv());
    compute_inverse_dynamics(mechanism, kinematics, v, vdot, forces, workspace, tau);
    return tau;
  }

  Random random;
  Mechanism mechanism;
  Eigen::VectorXd q, v;
  std::vector<ForceVector> forces;
  Kinematics kinematics;
};

class RandomTree : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomTree, VelocitiesAreRatesOfThePoses) {
  MovingTree s(GetParam());
  const double h = 1e-5;
  Kinematics before(s.mechanism);
  Kinematics after(s.mechanism);
  Eigen::VectorXd q(s.mechanism.nq());
  s.mechanism.integrate(s.q, s.v, -h, q);
  compute_kinematics(s.mechanism, q, s.v, before);
  s.mechanism.integrate(s.q, s.v, h, q);
  compute_kinematics(s.mechanism, q, s.v, after);
  for (std::size_t b = 0; b < s.mechanism.bodies().size(); ++b) {
    const Vector3 linear = (after.X_WB[b].p - before.X_WB[b].p) / (2 * h);
    const Matrix3 W =
        (after.X_WB[b].R - before.X_WB[b].R) / (2 * h) * s.kinematics.X_WB[b].R.transpose();
    EXPECT_LT((linear - s.kinematics.V_WB[b].linear).norm(), 1e-6) << b;
    EXPECT_LT((W - skew(s.kinematics.V_WB[b].angular)).norm(), 1e-6) << b;
  }
}

TEST_P(RandomTree, AccelerationsAreRatesOfTheVelocities) {
  MovingTree s(GetParam());
  const Eigen::VectorXd vdot = s.random.values(s.mechanism.nv(), 3);
  std::vector<MotionVector> A(s.mechanism.bodies().size());
  compute_accelerations(s.mechanism, s.kinematics, vdot, A);
  // q goes with the mean velocity of the interval, which is exact to second order.
  const double h = 1e-5;
  Kinematics before(s.mechanism);
  Kinematics after(s.mechanism);
  Eigen::VectorXd q(s.mechanism.nq());
  s.mechanism.integrate(s.q, s.v - 0.5 * h * vdot, -h, q);
  compute_kinematics(s.mechanism, q, s.v - h * vdot, before);
  s.mechanism.integrate(s.q, s.v + 0.5 * h * vdot, h, q);
  compute_kinematics(s.mechanism, q, s.v + h * vdot, after);
  for (std::size_t b = 0; b < A.size(); ++b) {
    const MotionVector rate = (0.5 / h) * (after.V_WB[b] - before.V_WB[b]);
    EXPECT_LT((rate.linear - A[b].linear).norm(), 1e-5) << b;
    EXPECT_LT((rate.angular - A[b].angular).norm(), 1e-5) << b;
  }
}

TEST_P(RandomTree, RatesMoveLikeTheManifold) {
  MovingTree s(GetParam());
  const double h = 1e-5;
  Eigen::VectorXd before(s.mechanism.nq());
  Eigen::VectorXd after(s.mechanism.nq());
  Eigen::VectorXd rates(s.mechanism.nq());
  s.mechanism.integrate(s.q, s.v, -h, before);
  s.mechanism.integrate(s.q, s.v, h, after);
  s.mechanism.calc_rates(s.q, s.v, rates);
  EXPECT_LT((rates - (after - before) / (2 * h)).norm(), 1e-8);
  // Difference is the inverse of integration.
  Eigen::VectorXd v(s.mechanism.nv());
  s.mechanism.integrate(s.q, s.v, 0.3, after);
  s.mechanism.difference(s.q, after, v);
  EXPECT_LT((v - 0.3 * s.v).norm(), 1e-13);
}

TEST_P(RandomTree, JacobiansGiveTheVelocities) {
  MovingTree s(GetParam());
  const Vector3 p_BoQ_B = s.random.vector(1);
  Eigen::Matrix3Xd J_point(3, s.mechanism.nv());
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_body(6, s.mechanism.nv());
  for (BodyIndex body = 0; body < s.mechanism.body_count(); ++body) {
    point_jacobian(s.mechanism, s.kinematics, body, p_BoQ_B, J_point);
    EXPECT_LT((J_point * s.v - point_velocity(s.kinematics, body, p_BoQ_B)).norm(), 1e-12);
    body_jacobian(s.mechanism, s.kinematics, body, J_body);
    const MotionVector& V = s.kinematics.V_WB[body];
    EXPECT_LT((J_body.topRows<3>() * s.v - V.angular).norm(), 1e-12);
    EXPECT_LT((J_body.bottomRows<3>() * s.v - V.linear).norm(), 1e-12);
  }
}

TEST_P(RandomTree, ForwardDynamicsInvertsInverseDynamics) {
  MovingTree s(GetParam());
  Eigen::VectorXd tau = s.random.values(s.mechanism.nv(), 10);
  Eigen::VectorXd vdot = Eigen::VectorXd::Constant(s.mechanism.nv(), not_a_number);
  ForwardDynamicsWorkspace workspace(s.mechanism);
  compute_forward_dynamics(s.mechanism, s.kinematics, s.v, s.forces, workspace, tau, vdot);
  const Eigen::VectorXd back = s.inverse(vdot);
  EXPECT_LT((back - tau).norm(), 1e-12 * (tau.norm() + s.inverse(0 * vdot).norm()));
  // The accelerations that come along are vdot's.
  std::vector<MotionVector> A(workspace.A_WB.size());
  compute_accelerations(s.mechanism, s.kinematics, vdot, A);
  for (std::size_t b = 0; b < A.size(); ++b) {
    const double size = 1 + A[b].linear.norm() + A[b].angular.norm();
    EXPECT_LT((A[b].linear - workspace.A_WB[b].linear).norm(), 1e-12 * size);
    EXPECT_LT((A[b].angular - workspace.A_WB[b].angular).norm(), 1e-12 * size);
  }
}

TEST_P(RandomTree, MassMatrixAndBiasMakeTheEquationsOfMotion) {
  MovingTree s(GetParam());
  const Eigen::VectorXd vdot = s.random.values(s.mechanism.nv(), 3);
  MassMatrixWorkspace workspace(s.mechanism);
  Eigen::MatrixXd M(s.mechanism.nv(), s.mechanism.nv());
  compute_mass_matrix(s.mechanism, s.kinematics, workspace, M);
  const Eigen::VectorXd tau = s.inverse(vdot);
  EXPECT_LT((M * vdot + s.inverse(0 * vdot) - tau).norm(), 1e-12 * tau.norm());
  EXPECT_EQ(M, M.transpose());
  EXPECT_EQ(M.llt().info(), Eigen::Success);
  const double energy = calc_kinetic_energy(s.mechanism, s.kinematics);
  EXPECT_NEAR(0.5 * s.v.dot(M * s.v), energy, 1e-12 * energy);
}

// Driven velocities: what comes out must satisfy inverse dynamics with the same drive forces.
TEST_P(RandomTree, HybridDynamicsAgreesWithInverseDynamics) {
  MovingTree s(GetParam(), true);
  ASSERT_FALSE(s.mechanism.driven_velocities().empty());
  Eigen::VectorXd tau = s.random.values(s.mechanism.nv(), 10);
  Eigen::VectorXd vdot = s.random.values(s.mechanism.nv(), 3);
  const Eigen::VectorXd given_tau = tau;
  const Eigen::VectorXd given_vdot = vdot;
  for (const int k : s.mechanism.driven_velocities()) tau[k] = not_a_number;
  for (const int k : s.mechanism.free_velocities()) vdot[k] = not_a_number;
  ForwardDynamicsWorkspace workspace(s.mechanism);
  compute_forward_dynamics(s.mechanism, s.kinematics, s.v, s.forces, workspace, tau, vdot);
  for (const int k : s.mechanism.free_velocities()) EXPECT_EQ(tau[k], given_tau[k]);
  for (const int k : s.mechanism.driven_velocities()) EXPECT_EQ(vdot[k], given_vdot[k]);
  EXPECT_LT((s.inverse(vdot) - tau).norm(), 1e-12 * (tau.norm() + s.inverse(0 * vdot).norm()));
}

// Leaving the forces of drives out changes not a bit of the accelerations.
TEST_P(RandomTree, AccelerationsDoNotDependOnWhetherDriveForcesAreWanted) {
  MovingTree s(GetParam(), true);
  const Eigen::VectorXd given_tau = s.random.values(s.mechanism.nv(), 10);
  const Eigen::VectorXd given_vdot = s.random.values(s.mechanism.nv(), 3);
  ForwardDynamicsWorkspace wanted(s.mechanism), unwanted(s.mechanism);
  Eigen::VectorXd tau = given_tau, vdot = given_vdot;
  compute_forward_dynamics(s.mechanism, s.kinematics, s.v, s.forces, wanted, tau, vdot);
  Eigen::VectorXd other_tau = given_tau, other_vdot = given_vdot;
  compute_forward_dynamics(s.mechanism, s.kinematics, s.v, s.forces, unwanted, other_tau,
                           other_vdot, DriveForces::unwanted);
  EXPECT_EQ(other_vdot, vdot);
  for (std::size_t b = 0; b < wanted.A_WB.size(); ++b) {
    EXPECT_EQ(unwanted.A_WB[b].linear, wanted.A_WB[b].linear);
    EXPECT_EQ(unwanted.A_WB[b].angular, wanted.A_WB[b].angular);
  }
}

// Rate of kinetic energy = power of joint forces, external forces and gravity, less the damping.
TEST_P(RandomTree, PowerBalances) {
  MovingTree s(GetParam());
  const Eigen::VectorXd vdot = s.random.values(s.mechanism.nv(), 3);
  const Eigen::VectorXd tau = s.inverse(vdot);
  const double h = 1e-5;
  const auto energy = [&](double t) {
    Kinematics k(s.mechanism);
    Eigen::VectorXd q(s.mechanism.nq());
    s.mechanism.integrate(s.q, s.v + 0.5 * t * vdot, t, q);
    compute_kinematics(s.mechanism, q, s.v + t * vdot, k);
    return calc_kinetic_energy(s.mechanism, k) + calc_gravity_potential(s.mechanism, k);
  };
  double power = tau.dot(s.v) - calc_damping_power(s.mechanism, s.v);
  for (std::size_t b = 0; b < s.forces.size(); ++b) {
    power += dot(s.forces[b], s.kinematics.V_WB[b]);
  }
  EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), power, 1e-6 * (1 + std::abs(power)));
}

// The world carries the weight, the loads and the rate of momentum of the whole tree.
TEST_P(RandomTree, ReactionOfTheWorldIsTheRateOfMomentum) {
  MovingTree s(GetParam());
  const Eigen::VectorXd vdot = s.random.values(s.mechanism.nv(), 3);
  InverseDynamicsWorkspace workspace(s.mechanism);
  Eigen::VectorXd tau(s.mechanism.nv());
  compute_inverse_dynamics(s.mechanism, s.kinematics, s.v, vdot, s.forces, workspace, tau);
  const double h = 1e-5;
  const auto momentum = [&](double t) {
    Kinematics k(s.mechanism);
    Eigen::VectorXd q(s.mechanism.nq());
    s.mechanism.integrate(s.q, s.v + 0.5 * t * vdot, t, q);
    compute_kinematics(s.mechanism, q, s.v + t * vdot, k);
    return calc_momentum(s.mechanism, k);
  };
  const ForceVector rate = (0.5 / h) * (momentum(h) - momentum(-h));
  const RigidBodyInertia all = calc_mass_properties(s.mechanism, s.kinematics);
  const Vector3 weight = all.mass * s.mechanism.gravity();
  ForceVector expected = rate - ForceVector{all.p_BoBcm.cross(weight), weight};
  for (std::size_t b = 0; b < s.forces.size(); ++b) {
    expected = expected - shift_to(s.forces[b], s.kinematics.X_WB[b].p);
  }
  const ForceVector& found = workspace.F_joint_W[0];
  EXPECT_LT((found.force - expected.force).norm(), 1e-6 * (1 + expected.force.norm()));
  EXPECT_LT((found.moment - expected.moment).norm(), 1e-6 * (1 + expected.moment.norm()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTree, ::testing::Range(1u, 21u));

// Two drives on a known system: a trolley (prismatic) with a load on a rigid pendulum (revolute).
TEST(HybridDynamics, TrolleyDrivenUnderAPendulum) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -9.81});
  BodyDefinition trolley;
  trolley.name = "trolley";
  trolley.joint = {JointKind::prismatic, Vector3::UnitX()};
  trolley.mass = 3;
  trolley.driven = {true};
  builder.add_body(trolley);
  BodyDefinition load;
  load.name = "load";
  load.parent = "trolley";
  load.joint = {JointKind::revolute, -Vector3::UnitY()};
  load.mass = 2;
  load.p_BoBcm_B = {0, 0, -5};
  builder.add_body(load);
  const Mechanism mechanism = builder.build();
  const Eigen::Vector2d q(1.0, 0.3);
  const Eigen::Vector2d v(0.4, 0.2);
  Kinematics kinematics(mechanism);
  compute_kinematics(mechanism, q, v, kinematics);
  ForwardDynamicsWorkspace workspace(mechanism);
  Eigen::VectorXd tau = Eigen::Vector2d(not_a_number, 0);
  Eigen::VectorXd vdot = Eigen::Vector2d(0.7, not_a_number);
  compute_forward_dynamics(mechanism, kinematics, v, examples::no_forces(mechanism), workspace, tau,
                           vdot);
  // Load at x + l sin(phi):  l phi'' = -g sin(phi) - x'' cos(phi).
  const double angular = -(9.81 * std::sin(0.3) + 0.7 * std::cos(0.3)) / 5;
  EXPECT_NEAR(vdot[1], angular, 1e-14);
  const double force = 5 * 0.7 + 2 * 5 * (angular * std::cos(0.3) - 0.2 * 0.2 * std::sin(0.3));
  EXPECT_NEAR(tau[0], force, 1e-13);
}

}  // namespace
}  // namespace blocklift::dynamics
