#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// Workspace of compute_mass_matrix.
struct MassMatrixWorkspace {
  explicit MassMatrixWorkspace(const Mechanism& mechanism);

  /// For each body that moves: inertia of it and all it carries, about Bo, in W.
  std::vector<SpatialInertia> composite;
};

/// Mass matrix M (nv x nv, symmetric) of the tree: composite-rigid-body algorithm (Featherstone
/// 2008, section 6.2). The equations of motion read  M(q) vdot + h(q, v) = tau,  h being what
/// inverse dynamics returns for vdot = 0. Driven velocities are included like others. Does not
/// allocate.
void compute_mass_matrix(const Mechanism& mechanism, const Kinematics& kinematics,
                         MassMatrixWorkspace& workspace, Eigen::Ref<Eigen::MatrixXd> mass_matrix);

}  // namespace blocklift::dynamics
