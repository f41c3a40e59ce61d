// Links without mass, poses in which a motion meets no resistance, states that are not finite,
// quaternions of any length: a right answer, or an error that names the body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/forward_dynamics.h"

namespace blocklift::dynamics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

BodyDefinition massless(const std::string& name, const std::string& parent, const Vector3& axis) {
  return {.name = name, .parent = parent, .joint = {JointKind::revolute, axis}, .mass = 0};
}

Eigen::VectorXd accelerations(const Mechanism& mechanism, const Eigen::VectorXd& q,
                              const Eigen::VectorXd& v, std::vector<ForceVector> forces = {}) {
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  forces.resize(mechanism.body_count(), ForceVector::zero());
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(mechanism.nv()), vdot = tau;
  compute_kinematics(mechanism, q, v, kinematics);
  compute_forward_dynamics(mechanism, kinematics, v, forces, workspace, tau, vdot);
  return vdot;
}

std::string message(const Mechanism& mechanism, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    std::vector<ForceVector> forces = {}) {
  try {
    accelerations(mechanism, q, v, std::move(forces));
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

BodyDefinition solid(const std::string& parent, Joint joint) {
  return {.name = "load",
          .parent = parent,
          .joint = joint,
          .mass = 3,
          .p_BoBcm_B = {0.1, -0.2, -0.8},
          .I_BBcm_B = Vector3(0.4, 0.5, 0.3).asDiagonal()};
}

// A universal joint is two revolute ones with a cross without mass between them.
TEST(LinkWithoutMass, CrossOfAUniversalJoint) {
  MechanismBuilder one, two;
  one.add_body(solid("world", {JointKind::universal, Vector3::UnitX(), Vector3::UnitY()}));
  two.add_body(massless("cross", "world", Vector3::UnitX()));
  two.add_body(solid("cross", {JointKind::revolute, Vector3::UnitY()}));
  const Eigen::Vector2d q(0.7, -0.4), v(1.3, 2.1);
  const Eigen::VectorXd a = accelerations(one.build(), q, v);
  const Eigen::VectorXd b = accelerations(two.build(), q, v);
  EXPECT_LT((a - b).norm(), 1e-12 * a.norm());
}

// Three axes that carry a load through two rings without mass, against a spherical joint: the same
// angular acceleration of the load in W.
TEST(LinkWithoutMass, RingsOfAGimbalAgainstASphericalJoint) {
  MechanismBuilder rings, ball;
  rings.add_body(massless("outer", "world", Vector3::UnitX()));
  rings.add_body(massless("inner", "outer", Vector3::UnitY()));
  rings.add_body(solid("inner", {JointKind::revolute, Vector3::UnitZ()}));
  ball.add_body(solid("world", {JointKind::spherical}));
  const Mechanism a = rings.build(), b = ball.build();
  const Vector3 q(0.3, 0.5, -0.8), v(0.9, -1.1, 0.6);
  Kinematics ka(a), kb(b);
  compute_kinematics(a, q, v, ka);
  const Vector4 quaternion = quaternion_from_rotation(ka.X_WB[3].R);
  const Vector3 w_B = ka.X_WB[3].R.transpose() * ka.V_WB[3].angular;
  compute_kinematics(b, quaternion, w_B, kb);
  std::vector<MotionVector> Aa(4, MotionVector::zero()), Ab(2, MotionVector::zero());
  compute_accelerations(a, ka, accelerations(a, q, v), Aa);
  compute_accelerations(b, kb, accelerations(b, quaternion, w_B), Ab);
  EXPECT_LT((Aa[3].angular - Ab[1].angular).norm(), 1e-12 * Ab[1].angular.norm());
}

// In gimbal lock the outer ring turns about the load's own axis: one of the two meets no
// resistance.
TEST(SingularPose, GimbalLockNamesTheRing) {
  MechanismBuilder builder;
  builder.add_body(massless("outer", "world", Vector3::UnitX()));
  builder.add_body(massless("inner", "outer", Vector3::UnitY()));
  builder.add_body(solid("inner", {JointKind::revolute, Vector3::UnitZ()}));
  const Mechanism mechanism = builder.build();
  const Vector3 v(0.1, 0.2, 0.3);
  EXPECT_THAT(message(mechanism, Vector3(0.4, M_PI_2, 0.2), v),
              HasSubstr("body \"outer\" (revolute): nothing resists this motion"));
  // A thousandth of a degree away it still moves.
  EXPECT_EQ(message(mechanism, Vector3(0.4, M_PI_2 - 1.7e-5, 0.2), v), "");
}

TEST(SingularPose, ATurnAboutTheLineThroughAPointMassIsNamed) {
  MechanismBuilder builder;
  builder.add_body(
      {.name = "bob", .joint = {JointKind::spherical}, .mass = 2, .p_BoBcm_B = {0, 0, -1}});
  const Mechanism mechanism = builder.build();
  EXPECT_THAT(message(mechanism, Vector4(1, 0, 0, 0), Vector3::Zero()),
              AllOf(HasSubstr("\"bob\" (spherical, velocity 3 of 3, turning)"),
                    HasSubstr("nothing resists this motion")));
}

TEST(NotFinite, TheBodyWhereItBeganIsNamed) {
  MechanismBuilder builder;
  builder.add_body(solid("world", {JointKind::revolute, Vector3::UnitX()}));
  BodyDefinition tip = solid("load", {JointKind::revolute, Vector3::UnitX()});
  tip.name = "tip";
  builder.add_body(tip);
  const Mechanism mechanism = builder.build();
  const Eigen::Vector2d fine(0.1, 0.2);
  EXPECT_THAT(message(mechanism, Eigen::Vector2d(NAN, 0), fine),
              HasSubstr("body \"load\": its pose is not finite"));
  EXPECT_THAT(message(mechanism, fine, Eigen::Vector2d(0, INFINITY)),
              HasSubstr("body \"tip\": its velocity is not finite"));
  std::vector<ForceVector> forces(3, ForceVector::zero());
  forces[2].force.x() = NAN;
  EXPECT_THAT(message(mechanism, fine, fine, forces),
              HasSubstr("body \"tip\": the external force on it is not finite"));
}

TEST(Quaternion, ItsLengthDoesNotMatter) {
  MechanismBuilder builder;
  builder.add_body(solid("world", {JointKind::free}));
  const Mechanism mechanism = builder.build();
  Eigen::VectorXd q(7), v(6);
  q << 1, 2, 3, 0.5, -0.1, 0.7, 0.4;
  v << 1, -2, 3, 0.4, 0.5, 0.6;
  const Eigen::VectorXd a = accelerations(mechanism, q, v);
  Eigen::VectorXd longer = q;
  longer.tail<4>() *= -7.0;
  EXPECT_LT((accelerations(mechanism, longer, v) - a).norm(), 1e-13 * a.norm());
  // Moving on from it gives a unit quaternion, and the difference of both is none.
  Eigen::VectorXd moved(7), back(6);
  mechanism.integrate(longer, v, 0.1, moved);
  EXPECT_NEAR(moved.tail<4>().norm(), 1.0, 1e-15);
  mechanism.difference(q, longer, back);
  EXPECT_LT(back.norm(), 1e-14);
  longer.tail<4>().setZero();
  EXPECT_THAT(message(mechanism, longer, v), HasSubstr("body \"load\": its pose is not finite"));
}

}  // namespace
}  // namespace blocklift::dynamics
