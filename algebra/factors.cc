#include "algebra/factors.h"

#include <Eigen/Dense>

namespace blocklift::algebra {

template <class Number>
LuFactors<Number>::LuFactors() = default;

template <class Number>
LuFactors<Number>::LuFactors(Eigen::Index size) : factors_(size) {}

template <class Number>
LuFactors<Number>::LuFactors(const Matrix& A) : factors_(A) {}

template <class Number>
void LuFactors<Number>::factorise(const Eigen::Ref<const Matrix>& A) {
  factors_.compute(A);
}

template <class Number>
bool LuFactors<Number>::is_regular() const {
  const auto pivots = factors_.matrixLU().diagonal();
  // A pivot of zero shows as a factor that is not finite once it has been divided by.
  return pivots.size() == 0 || (pivots.allFinite() && pivots.cwiseAbs().minCoeff() > 0.0);
}

template <class Number>
void LuFactors<Number>::solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const {
  x = factors_.solve(b);
}

template <class Number>
auto LuFactors<Number>::solve(const Eigen::Ref<const Vector>& b) const -> Vector {
  return factors_.solve(b);
}

template <class Number>
void LuFactors<Number>::solve_columns(const Eigen::Ref<const Matrix>& B,
                                      Eigen::Ref<Matrix> X) const {
  X = factors_.solve(B);
}

template <class Number>
auto LuFactors<Number>::solve_columns(const Eigen::Ref<const Matrix>& B) const -> Matrix {
  Matrix X(B.rows(), B.cols());
  solve_columns(B, X);
  return X;
}

template <class Number>
auto LuFactors<Number>::solve_transposed(const Eigen::Ref<const Vector>& b) const -> Vector {
  return factors_.transpose().solve(b);
}

template class LuFactors<double>;
template class LuFactors<std::complex<double>>;

CholeskyFactors::CholeskyFactors() = default;

CholeskyFactors::CholeskyFactors(Eigen::Index size) : factors_(size) {}

CholeskyFactors::CholeskyFactors(const Eigen::MatrixXd& A) : factors_(A) {}

void CholeskyFactors::factorise(const Eigen::Ref<const Eigen::MatrixXd>& A) { factors_.compute(A); }

bool CholeskyFactors::is_positive() const { return factors_.info() == Eigen::Success; }

void CholeskyFactors::solve_in_place(Eigen::Ref<Eigen::VectorXd> b) const {
  factors_.solveInPlace(b);
}

void CholeskyFactors::solve_columns_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
  factors_.solveInPlace(B);
}

Eigen::MatrixXd CholeskyFactors::lower() const { return factors_.matrixL(); }

Eigen::MatrixXd CholeskyFactors::inverse_of_transposed() const {
  const Eigen::Index n = factors_.rows();
  return factors_.matrixU().solve(Eigen::MatrixXd::Identity(n, n));
}

SymmetricFactors::SymmetricFactors() = default;

SymmetricFactors::SymmetricFactors(const Eigen::MatrixXd& A) : factors_(A) {}

Eigen::VectorXd SymmetricFactors::solve(const Eigen::Ref<const Eigen::VectorXd>& b) const {
  return factors_.solve(b);
}

}  // namespace blocklift::algebra
