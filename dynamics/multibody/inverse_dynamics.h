#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// Workspace and by-products of compute_inverse_dynamics, one entry a body, the world included.
struct InverseDynamicsWorkspace {
  explicit InverseDynamicsWorkspace(const Mechanism& mechanism);

  std::vector<MotionVector> A_WB;  ///< accelerations at Bo, in W
  /// Force that the parent exerts on the body through its joint, about Bo, in W (paper eq. 4).
  /// Entry 0 is the sum of what the world exerts on its children and of loads put on the world,
  /// about Wo.
  std::vector<ForceVector> F_joint_W;
};

/// Joint forces tau that produce the accelerations vdot: recursive Newton-Euler (paper eq. 1-5).
///
/// F_Bo_W: external force on each body about Bo, in W, without gravity and joint forces; body_count
/// entries. Viscous damping of the joints is taken as part of the mechanism: tau is what acts
/// besides, so that forward dynamics with this tau returns vdot. v, vdot, tau: nv entries. Does not
/// allocate.
void compute_inverse_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                              ConstVectorRef v, ConstVectorRef vdot,
                              const std::vector<ForceVector>& F_Bo_W,
                              InverseDynamicsWorkspace& workspace, VectorRef tau);

}  // namespace blocklift::dynamics
