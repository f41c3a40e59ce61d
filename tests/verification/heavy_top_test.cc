// Heavy top on a spherical joint: the benchmark of Brüls and Cardona (2010) as used by Exudyn's
// examples. The top spins fast, so quaternions, gyroscopic terms and the spherical joint all count.
#include <gtest/gtest.h>

#include "dynamics/multibody/energy.h"
#include "tests/dynamics/multibody/runge_kutta.h"

namespace blocklift::dynamics {
namespace {

Mechanism heavy_top() {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -9.81});
  BodyDefinition top;
  top.name = "top";
  top.joint.kind = JointKind::spherical;
  top.mass = 15;
  top.p_BoBcm_B = {0, 1, 0};
  top.I_BBcm_B = Vector3(0.234375, 0.46875, 0.234375).asDiagonal();
  builder.add_body(top);
  return builder.build();
}

test::RungeKutta run(const Mechanism& mechanism, double duration, int steps) {
  test::RungeKutta top(mechanism, mechanism.zero_configuration(), Vector3(0, 150, -4.61538));
  top.advance(duration, steps);
  return top;
}

// Exudyn's reference, ten digits: quaternion at 0.2 s. Half a unit of its last digit, and the
// integration's own error, which the order test below bounds at this step: 1e-9 in all.
TEST(HeavyTop, QuaternionAtTwoTenthsOfASecond) {
  const Mechanism mechanism = heavy_top();
  Vector4 quaternion = run(mechanism, 0.2, 40000).q;
  const Vector4 reference(-0.7082791530, 0.4387810881, 0.5457283961, 0.0893997528);
  if (quaternion.dot(reference) < 0) quaternion = -quaternion;
  EXPECT_LT((quaternion - reference).cwiseAbs().maxCoeff(), 1e-9) << quaternion.transpose();
}

// Euler's equations integrated by tests/verification/references: centre of mass at 1 s.
TEST(HeavyTop, CentreOfMassAtOneSecond) {
  const Mechanism mechanism = heavy_top();
  const Vector3 p = point_position(run(mechanism, 1.0, 200000).kinematics(), 1, {0, 1, 0});
  const Vector3 reference(0.1733439641, 0.6400885921, -0.7484907911);
  EXPECT_LT((p - reference).cwiseAbs().maxCoeff(), 1e-9) << p.transpose();
}

// Halving the step divides the error by 2^4, so that the figures above are converged.
TEST(HeavyTop, ConvergesWithTheFourthOrder) {
  const Mechanism mechanism = heavy_top();
  const Vector4 coarse = run(mechanism, 0.2, 2000).q;
  const Vector4 medium = run(mechanism, 0.2, 4000).q;
  const Vector4 fine = run(mechanism, 0.2, 8000).q;
  const double order = std::log2((coarse - medium).norm() / (medium - fine).norm());
  EXPECT_NEAR(order, 4.0, 0.2);
}

TEST(HeavyTop, KeepsItsEnergyAndTheMomentumAboutTheVertical) {
  const Mechanism mechanism = heavy_top();
  const auto invariants = [&](const Kinematics& k) {
    return Eigen::Vector2d(calc_kinetic_energy(mechanism, k) + calc_gravity_potential(mechanism, k),
                           calc_momentum(mechanism, k).moment.z());
  };
  const Eigen::Vector2d start = invariants(run(mechanism, 0, 1).kinematics());
  const Eigen::Vector2d end = invariants(run(mechanism, 1.0, 100000).kinematics());
  EXPECT_NEAR(end[0], start[0], 1e-9 * start[0]);
  EXPECT_NEAR(end[1], start[1], 1e-9 * std::abs(start[1]));
}

}  // namespace
}  // namespace blocklift::dynamics
