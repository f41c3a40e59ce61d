#include <algorithm>

#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "pipeline/verification/dynamics/dynamics_cases.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// Largest disagreements over the trees, relative to the joint forces.
struct Disagreements {
  double forward = 0.0;      ///< inverse dynamics of forward dynamics' accelerations
  double hybrid = 0.0;       ///< the same with some joints driven
  double mass_matrix = 0.0;  ///< M vdot + h against inverse dynamics
};

class RandomTree {
 public:
  RandomTree(unsigned seed, bool with_drives)
      : random_(seed),
        mechanism_(examples::random_tree(random_, 12, with_drives)),
        q_(examples::random_configuration(random_, mechanism_)),
        v_(random_.values(mechanism_.nv(), 2)),
        forces_(examples::random_forces(random_, mechanism_)),
        kinematics_(mechanism_) {
    compute_kinematics(mechanism_, q_, v_, kinematics_);
  }

  double forward_against_inverse() {
    Eigen::VectorXd tau = random_.values(mechanism_.nv(), 10);
    Eigen::VectorXd vdot = random_.values(mechanism_.nv(), 3);  // free entries are found
    ForwardDynamicsWorkspace workspace(mechanism_);
    compute_forward_dynamics(mechanism_, kinematics_, v_, forces_, workspace, tau, vdot);
    return (inverse(vdot) - tau).norm() / (tau.norm() + inverse(0 * vdot).norm());
  }

  double mass_matrix_against_inverse() {
    const Eigen::VectorXd vdot = random_.values(mechanism_.nv(), 3);
    MassMatrixWorkspace workspace(mechanism_);
    Eigen::MatrixXd M(mechanism_.nv(), mechanism_.nv());
    compute_mass_matrix(mechanism_, kinematics_, workspace, M);
    const Eigen::VectorXd tau = inverse(vdot);
    return (M * vdot + inverse(0 * vdot) - tau).norm() / tau.norm();
  }

 private:
  Eigen::VectorXd inverse(const Eigen::VectorXd& vdot) const {
    InverseDynamicsWorkspace workspace(mechanism_);
    Eigen::VectorXd tau(mechanism_.nv());
    compute_inverse_dynamics(mechanism_, kinematics_, v_, vdot, forces_, workspace, tau);
    return tau;
  }

  examples::Random random_;
  Mechanism mechanism_;
  Eigen::VectorXd q_, v_;
  std::vector<ForceVector> forces_;
  Kinematics kinematics_;
};

Disagreements disagreements_of_random_trees(unsigned count) {
  Disagreements largest;
  for (unsigned seed = 1; seed <= count; ++seed) {
    RandomTree tree(seed, false);
    RandomTree driven(seed, true);
    largest.forward = std::max(largest.forward, tree.forward_against_inverse());
    largest.hybrid = std::max(largest.hybrid, driven.forward_against_inverse());
    largest.mass_matrix = std::max(largest.mass_matrix, tree.mass_matrix_against_inverse());
  }
  return largest;
}

}  // namespace

VerificationCase random_trees() {
  return {.name = "random-trees",
          .stage = "dynamics",
          .source = "three recursive algorithms against each other (Featherstone 2008)",
          .compute = [] {
            constexpr unsigned count = 50;
            constexpr double tolerance = 1e-12;
            const Disagreements found = disagreements_of_random_trees(count);
            const std::string trees = ", 50 trees, relative";
            return std::vector<VerificationRow>{
                bound("forward against inverse dynamics" + trees, "1", found.forward, tolerance),
                bound("the same with some joints driven" + trees, "1", found.hybrid, tolerance),
                bound("mass matrix against inverse dynamics" + trees, "1", found.mass_matrix,
                      tolerance)};
          }};
}

}  // namespace blocklift::pipeline
