#pragma once

#include <optional>

#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// The motions that the loops leave free next to a reference configuration, as independent coordinates z:
///   q(z) = the configuration on the loops nearest to  q_reference (+) Z z,
/// Z (nv_free x n) being an orthonormal basis of what the loops allow at the reference. Without loops
/// z are the increments of all free velocities, Z = 1.
class ReducedCoordinates {
 public:
  explicit ReducedCoordinates(const LiftSystem& system);

  /// Brings q (nq) onto the loops and makes it the reference.
  /// @throws SimulationError if the loops cannot be closed near by.
  void set_reference(VectorRef q);
  const Eigen::VectorXd& reference() const { return reference_; }

  Eigen::Index size() const { return basis_.cols(); }
  const Eigen::MatrixXd& basis() const { return basis_; }  ///< Z

  /// q (nq) = q(z). Loops are evaluated there. @throws SimulationError as set_reference.
  void move_to(const Eigen::VectorXd& z, VectorRef q);
  /// How dz moves the pose q(z) of the last move_to: increments of the free velocities, nv_free x n.
  Eigen::MatrixXd tangent();

  /// Splits generalised forces f (nv_free) at rest at the last move_to into what the loops bear and the
  /// rest: f becomes f + G^T lambda, the part along the loops; lambda (rows) the least multipliers.
  void balance(VectorRef f, VectorRef lambda);
  /// G^T lambda of velocity k.
  double loop_force(int k, ConstVectorRef lambda) const;

 private:
  const LiftSystem& system_;
  std::optional<LoopProjector> projector_;
  Eigen::VectorXd reference_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd increment_;  ///< nv
};

}  // namespace blocklift::dynamics
