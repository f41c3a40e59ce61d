#include "dynamics/simulation/dense_newton_matrix.h"

#include <algorithm>
#include <cmath>

namespace blocklift::dynamics {

DenseNewtonMatrix::DenseNewtonMatrix(const LiftSystem& system)
    : jacobian_(system.state_size(), system.state_size()),
      matrix_(jacobian_),
      factor_(system.state_size()),
      shifted_(system.state_size()),
      base_(shifted_),
      rates_(shifted_),
      solution_(shifted_) {}

long DenseNewtonMatrix::set_point(const LiftSystem& system, double t, ConstVectorRef y,
                                  const Contacts& contacts, LiftWorkspace& w) {
  constexpr double increment = 1e-7;  // m, rad, m/s, rad/s
  const Eigen::Index n = system.state_size();
  calc_right_hand_side(system, t, y, &contacts, w, base_);
  shifted_ = y.head(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double value = shifted_[k];
    shifted_[k] += increment * std::max(1.0, std::abs(value));
    const double step = shifted_[k] - value;
    calc_right_hand_side(system, t, shifted_, &contacts, w, rates_);
    jacobian_.col(k) = (rates_ - base_) / step;
    shifted_[k] = value;
  }
  return n + 1;
}

bool DenseNewtonMatrix::factorise(double gamma) {
  matrix_ = -gamma * jacobian_;
  matrix_.diagonal().array() += 1.0;
  factor_.compute(matrix_);
  // A pivot of zero shows as a factor that is not finite once it has been divided by.
  const auto pivots = factor_.matrixLU().diagonal();
  return matrix_.rows() == 0 || (pivots.allFinite() && pivots.cwiseAbs().minCoeff() > 0.0);
}

void DenseNewtonMatrix::solve(ConstVectorRef b, VectorRef x) {
  solution_ = factor_.solve(b.head(solution_.size()));
  x.head(solution_.size()) = solution_;
}

}  // namespace blocklift::dynamics
