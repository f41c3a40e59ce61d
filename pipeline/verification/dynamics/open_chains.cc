#include <string>

#include "dynamics/multibody/forward_dynamics.h"
#include "pipeline/verification/dynamics/dynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// Links of 1 kg, 1 m and unit inertia about their centres of mass at their far ends.
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
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mechanism.nv());
  Eigen::VectorXd tau = zero;
  Eigen::VectorXd vdot = zero;
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  const std::vector<ForceVector> none(static_cast<std::size_t>(mechanism.body_count()),
                                      ForceVector::zero());
  compute_kinematics(mechanism, zero, zero, kinematics);
  compute_forward_dynamics(mechanism, kinematics, zero, none, workspace, tau, vdot);
  return vdot;
}

}  // namespace

// Fifteen digits are published; one and two links are -g/2 and (-3/5, 2/5) g in closed form.
VerificationCase open_chains() {
  return {.name = "open-chains",
          .stage = "dynamics",
          .source = "RBDL, tests of its forward dynamics (Felis 2017)",
          .compute = [] {
            const std::vector<std::vector<double>> references = {
                {-4.905}, {-5.886, 3.924}, {-6.03692307692308, 3.77307692307692, 1.50923076923077}};
            std::vector<VerificationRow> rows;
            for (const std::vector<double>& reference : references) {
              const Eigen::VectorXd vdot = released_from_rest(chain(int(reference.size())));
              for (std::size_t i = 0; i < reference.size(); ++i) {
                rows.push_back(compare("chain of " + std::to_string(reference.size()) +
                                           ", acceleration of joint " + std::to_string(i + 1),
                                       "rad/s^2", reference[i], vdot[Eigen::Index(i)], 1e-13));
              }
            }
            return rows;
          }};
}

}  // namespace blocklift::pipeline
