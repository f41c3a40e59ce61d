#pragma once

#include <optional>

#include "algebra/factors.h"
#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// The motions that the loops leave free next to a reference configuration, as independent
/// coordinates z:
///   q(z) = q_reference (+) w,   w = Z z + N y(z),   g(q(z)) = 0,
/// Z (nv_free x n) and N (nv_free x rank) being orthonormal bases of what the loops allow and
/// forbid at the reference: y is found by Newton's method. Derivatives of q(z) are exact wherever
/// it exists, not at the reference alone. Without loops z are the increments of all free
/// velocities, Z = 1. Source: Absil and Malick (2012), SIAM J. Optim. 22(1), "orthographic
/// retraction".
///
/// Generalised forces f (nv_free) at q(z) are balanced by multipliers with  N^T (f + G^T lambda) =
/// 0; what remains is  Z^T (f + G^T lambda) = P^T f  with  P = Z - N (G N)^-1 G Z.
class ReducedCoordinates {
 public:
  explicit ReducedCoordinates(const LiftSystem& system);

  /// Brings q (nq) onto the loops and makes it the reference, where the last move_to then is.
  /// @throws SimulationError if the loops cannot be closed near by.
  void set_reference(VectorRef q);
  const Eigen::VectorXd& reference() const { return reference_; }

  Eigen::Index size() const { return basis_.cols(); }
  const Eigen::MatrixXd& basis() const { return basis_; }  ///< Z

  /// q (nq) = q(z). @throws SimulationError where the loops cannot be closed along N.
  void move_to(const Eigen::VectorXd& z, VectorRef q);
  /// How dz moves the pose q(z) of the last move_to: increments of the free velocities, nv_free x
  /// n.
  Eigen::MatrixXd tangent();
  /// P there: the virtual motions that forces are weighed with, nv_free x n.
  Eigen::MatrixXd virtual_motions() const;

  /// P^T K T there, n x n: how forces that are weighed with P change with dz, K (nv_free x nv_free)
  /// being their change with the free velocities' increments and T tangent().
  Eigen::MatrixXd seen_along(const Eigen::MatrixXd& stiffness);

  /// Multipliers (all rows) of forces f (nv_free) there, which becomes f + G^T lambda. Where rows
  /// repeat others those left out are zero.
  void balance(VectorRef f, VectorRef lambda) const;
  /// The same at the reference, of all multipliers the least in the sum of squares.
  void balance_at_reference(VectorRef f, VectorRef lambda);
  /// G^T lambda of velocity k at the reference.
  double loop_force(int k, ConstVectorRef lambda) const;

 private:
  void evaluate(ConstVectorRef q);
  Eigen::VectorXd closing_move(const Eigen::MatrixXd& increments);

  const LiftSystem& system_;
  std::optional<LoopProjector> projector_;
  std::optional<LoopState> state_;  ///< at the last move_to
  Kinematics kinematics_;
  LoopRows rows_;  ///< independent at the reference
  Eigen::VectorXd reference_;
  Eigen::MatrixXd basis_;          ///< Z
  Eigen::MatrixXd normal_;         ///< N
  Eigen::MatrixXd jacobian_;       ///< rank x nv: G of the rows chosen
  Eigen::MatrixXd free_jacobian_;  ///< rank x nv_free
  algebra::LuFactors<double> gn_;  ///< G N, rank x rank
  Eigen::VectorXd increment_;      ///< nv: w
};

}  // namespace blocklift::dynamics
