#pragma once

#include <complex>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

// Factors of matrices for several right-hand sides, or made anew again and again, compiled once.
// Neither to factorise another matrix of the same size nor to solve into given memory allocates.
namespace blocklift::algebra {

/// LU factors of a square matrix of real or complex numbers, with partial pivoting.
template <class Number>
class LuFactors {
 public:
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

  LuFactors();
  /// With room for a matrix of this size.
  explicit LuFactors(Eigen::Index size);
  explicit LuFactors(const Matrix& A);

  void factorise(const Eigen::Ref<const Matrix>& A);
  /// Whether no pivot is zero and all are finite.
  bool is_regular() const;
  /// x of A x = b, in other memory than b's. Its numbers are large or none if A is singular.
  void solve(const Eigen::Ref<const Vector>& b, Eigen::Ref<Vector> x) const;
  Vector solve(const Eigen::Ref<const Vector>& b) const;
  /// X of A X = B, in other memory than B's and of its size.
  void solve_columns(const Eigen::Ref<const Matrix>& B, Eigen::Ref<Matrix> X) const;
  Matrix solve_columns(const Eigen::Ref<const Matrix>& B) const;
  /// x of A^T x = b.
  Vector solve_transposed(const Eigen::Ref<const Vector>& b) const;

 private:
  Eigen::PartialPivLU<Matrix> factors_;
};
extern template class LuFactors<double>;
extern template class LuFactors<std::complex<double>>;

/// L of A = L L^T, A being symmetric and positive definite; its lower half is read.
class CholeskyFactors {
 public:
  CholeskyFactors();
  /// With room for a matrix of this size.
  explicit CholeskyFactors(Eigen::Index size);
  explicit CholeskyFactors(const Eigen::MatrixXd& A);

  void factorise(const Eigen::Ref<const Eigen::MatrixXd>& A);
  /// Whether the matrix is positive definite, as it must be for all that follows.
  bool is_positive() const;
  /// Replaces b by x of A x = b.
  void solve_in_place(Eigen::Ref<Eigen::VectorXd> b) const;
  /// Replaces B by X of A X = B.
  void solve_columns_in_place(Eigen::Ref<Eigen::MatrixXd> B) const;
  Eigen::MatrixXd lower() const;                  ///< L
  Eigen::MatrixXd inverse_of_transposed() const;  ///< L^-T

 private:
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// Factors of a symmetric matrix that is positive or negative semidefinite, without square roots;
/// its lower half is read.
class SymmetricFactors {
 public:
  SymmetricFactors();
  explicit SymmetricFactors(const Eigen::MatrixXd& A);

  /// x of A x = b.
  Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& b) const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace blocklift::algebra
