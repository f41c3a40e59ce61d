#pragma once

#include <optional>
#include <vector>

#include "dynamics/multibody/added_inertia.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/loop_constraint.h"
#include "dynamics/multibody/mass_factor.h"
#include "dynamics/multibody/mass_matrix.h"
#include "dynamics/multibody/rank_revealing_qr.h"

namespace blocklift::dynamics {

/// A choice among the rows of all loops.
struct LoopRows {
  std::vector<int> rows = {};  ///< those chosen
  std::vector<int> slot = {};  ///< for each row its place among those chosen, -1: not chosen

  static LoopRows none(const Mechanism& mechanism);
  static LoopRows all(const Mechanism& mechanism);
  int count() const { return static_cast<int>(rows.size()); }
  /// The first `count` entries of `chosen` (indices within `from`). Does not allocate.
  void choose(const LoopRows& from, const std::vector<int>& chosen, Eigen::Index count);
};

/// Workspace and by-products of compute_constrained_dynamics.
struct ConstrainedDynamicsWorkspace {
  /// @param added inertia besides that of the bodies; may be null.
  explicit ConstrainedDynamicsWorkspace(const Mechanism& mechanism,
                                        const AddedInertia* added = nullptr);

  LoopState loops;
  Eigen::VectorXd lambda;  ///< multipliers of all rows, N or N m; see LoopState
  /// Rank of the Jacobian of the free velocities among the rows that were solved for.
  Eigen::Index rank = 0;

  InverseDynamicsWorkspace inverse;
  MassMatrixWorkspace composite;
  MassFactor factor;
  std::optional<AddedInertiaWorkspace> added;
  LoopRows all_rows;
  Eigen::MatrixXd mass;           ///< nv x nv
  Eigen::MatrixXd jacobian;       ///< rows x nv; as many rows as were solved for
  Eigen::MatrixXd free_jacobian;  ///< rows x free velocities, times L^-1
  RankRevealingQr qr;             ///< of its transpose
  Eigen::VectorXd bias;           ///< nv: joint forces at vdot = 0 of the free velocities
  Eigen::VectorXd accelerations;  ///< of all rows at vdot = 0 of the free velocities
  Eigen::VectorXd right, solution, multipliers;
  std::vector<char> group;  ///< for each row solved for: is it an angle?
};

/// Part of a row (scaled to unit length in the metric of the inverse mass) that must be new for it
/// to count as independent of the rows before it. On the constraint itself rounding is far smaller,
/// and a toggle position must be met within this angle to count as one.
inline constexpr double redundancy_threshold = 1e-8;

/// Accelerations, drive forces and multipliers of a mechanism with loops:
///   M vdot + h = tau + G^T lambda,   G vdot = gamma,
/// with tau and vdot half given and half found as in compute_forward_dynamics.
///
/// With M = L^T L over the free velocities (composite-rigid-body algorithm, LTL factorisation) and
/// B = G L^-1, the least change of y = L vdot that meets B y = gamma is sought (Gauss's principle
/// of least constraint); lambda follows from B^T lambda = that change. B^T is factorised with a
/// rank-revealing QR, whose condition is the square root of that of G M^-1 G^T. Where rows repeat
/// others (a Bricard linkage, a plane mechanism with spatial joints) vdot is unique, and of all
/// multipliers the least in the sum of squares (SI) are taken. In a toggle position, where G loses
/// rank for an instant, the accelerations along the lost row are those that least constraint gives:
/// finite, never NaN.
///
/// @param rows those to be enforced, independent near the present state; the multipliers of the
/// others are zero. For use off the constraint, where rows that repeat others contradict them by
/// rounding or by an integrator's trial step. Null: all rows, the rank being judged at this state.
///
/// @param added inertia that joins that of the bodies on the left-hand side, M + J^T A J, whatever
/// its size: the one with which the workspace was made, or null. There need not be any loops.
///
/// Does not allocate.
/// @throws SimulationError as compute_forward_dynamics and compute_loops.
void compute_constrained_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                                  ConstVectorRef q, ConstVectorRef v,
                                  const std::vector<ForceVector>& F_Bo_W, const LoopRows* rows,
                                  ConstrainedDynamicsWorkspace& workspace, VectorRef tau,
                                  VectorRef vdot, const AddedInertia* added = nullptr);

}  // namespace blocklift::dynamics
