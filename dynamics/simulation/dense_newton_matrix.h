#pragma once

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Solves Newton's equations of an implicit integration,  (1 - gamma J) x = b,  with the Jacobian
/// J = d(dy/dt)/dy of the whole right-hand side by forward differences: for mechanisms with loops, whose
/// multipliers depend on everything. Workspaces are made once.
class DenseNewtonMatrix {
 public:
  explicit DenseNewtonMatrix(const LiftSystem& system);

  /// Jacobian at (t, y). @returns the number of right-hand sides that it took.
  long set_point(const LiftSystem& system, double t, ConstVectorRef y, const Contacts& contacts,
                 LiftWorkspace& w);
  /// Factorises for a gamma (s) at the point set last. False: singular or not finite.
  bool factorise(double gamma);
  /// x = (1 - gamma J)^-1 b; sizes state_size. `x` may be `b`.
  void solve(ConstVectorRef b, VectorRef x);

 private:
  Eigen::MatrixXd jacobian_, matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
  Eigen::VectorXd shifted_, base_, rates_, solution_;
};

}  // namespace blocklift::dynamics
