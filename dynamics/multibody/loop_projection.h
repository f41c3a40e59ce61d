#pragma once

#include "dynamics/multibody/constrained_dynamics.h"

namespace blocklift::dynamics {

/// Brings positions and velocities of the free joints back onto the loops, the shortest way; driven
/// ones stay where they are. One thread each; the members do not allocate.
///
/// "Shortest" is in the sum of w_k delta_k^2 over the free velocities k, delta being the move on
/// the manifold of poses (Mechanism::integrate) and w the weights: by default 1 for each, a metre
/// counting as a radian, the norm in which an integrator judges its errors. Newton's method on
/// independent rows: delta = -G^+ g, quadratic near the constraint.
class LoopProjector {
 public:
  /// @param weights nv, positive: what moving each velocity costs; empty: 1 each.
  explicit LoopProjector(const Mechanism& mechanism, const Eigen::VectorXd& weights = {});

  /// Moves q (nq) until all residuals vanish to rounding, and judges anew which rows are
  /// independent there.
  /// @returns false if they do not vanish from here (q is then of no use).
  /// @throws SimulationError where the geometry of a loop is degenerate.
  bool project_positions(VectorRef q);

  /// Moves v (nv) until G v = 0 at the q of the last project_positions or look.
  /// @returns false if driven joints move so that no free velocity can follow; v is then as near as
  /// can be.
  bool project_velocities(VectorRef v);

  /// Takes out of v (nv, of which driven entries count as zero) what is not along the loops at that
  /// q.
  void remove_normal_part(VectorRef v);

  /// Splits generalised forces f of the free velocities (unit weights) at that q: f becomes
  /// f + G^T lambda, the part along the loops, lambda (rows) being the least multipliers.
  void balance(VectorRef f, VectorRef lambda);

  /// Evaluates everything at q without moving it.
  void look(ConstVectorRef q);

  /// Rows that are independent at the last q.
  const LoopRows& independent_rows() const { return independent_; }
  /// Residual and kinematics (of v = 0) at the last q.
  const LoopState& state() const { return state_; }
  const Kinematics& kinematics() const { return kinematics_; }
  /// Factorisation of the transposed Jacobian of the free velocities, rows in order of the loops,
  /// each column (velocity) divided by the root of its weight.
  const RankRevealingQr& factorisation() const { return qr_; }
  /// All rows of the Jacobian at the last q, rows x nv.
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }

 private:
  void evaluate(ConstVectorRef q);
  void factorise(const LoopRows& rows, double threshold);
  bool iterate(const LoopRows& rows, double threshold, VectorRef q);
  double largest_residual() const;

  const Mechanism& mechanism_;
  Kinematics kinematics_;
  LoopState state_;
  LoopRows all_, independent_;
  Eigen::MatrixXd jacobian_;
  RankRevealingQr qr_;
  std::vector<char> angles_, group_;
  Eigen::VectorXd inverse_root_weight_;  ///< of the free velocities
  Eigen::VectorXd zero_v_, move_, right_, free_move_;
};

}  // namespace blocklift::dynamics
