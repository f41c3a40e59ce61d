// Open chains of revolute joints against published accelerations.
#include <gtest/gtest.h>

#include "dynamics/multibody/forward_dynamics.h"

namespace blocklift::dynamics {
namespace {

Mechanism chain(int links) {
  MechanismBuilder builder;
  builder.set_gravity({0, -9.81, 0});
  std::string parent(world_name);
  for (int i = 0; i < links; ++i) {
    BodyDefinition link;
    link.name = "link" + std::to_string(i + 1);
    link.parent = parent;
    link.joint = {JointKind::revolute, Vector3::UnitZ()};
    if (i > 0) link.X_PJ = Pose::translation(Vector3::UnitX());
    link.mass = 1;
    link.p_BoBcm_B = Vector3::UnitX();
    link.I_BBcm_B.setIdentity();
    builder.add_body(link);
    parent = link.name;
  }
  return builder.build();
}

Eigen::VectorXd released_from_rest(const Mechanism& mechanism) {
  const int n = mechanism.nv();
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd vdot(n);
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  const std::vector<ForceVector> none(static_cast<std::size_t>(mechanism.body_count()),
                                      ForceVector::zero());
  compute_kinematics(mechanism, tau, tau, kinematics);
  compute_forward_dynamics(mechanism, kinematics, Eigen::VectorXd::Zero(n), none, workspace, tau,
                           vdot);
  return vdot;
}

// RBDL, tests of its forward dynamics (Felis 2017): accelerations at q = v = tau = 0, 15 digits given.
// One and two links are -g/2 and (-3/5, 2/5) g in closed form.
TEST(OpenChain, AccelerationsOfOneTwoAndThreeLinks) {
  EXPECT_NEAR(released_from_rest(chain(1))[0], -4.905, 1e-13);
  const Eigen::VectorXd two = released_from_rest(chain(2));
  EXPECT_NEAR(two[0], -5.886, 1e-13);
  EXPECT_NEAR(two[1], 3.924, 1e-13);
  const Eigen::VectorXd three = released_from_rest(chain(3));
  EXPECT_NEAR(three[0], -6.03692307692308, 1e-13);
  EXPECT_NEAR(three[1], 3.77307692307692, 1e-13);
  EXPECT_NEAR(three[2], 1.50923076923077, 1e-13);
}

}  // namespace
}  // namespace blocklift::dynamics
