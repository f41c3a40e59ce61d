#pragma once

#include <vector>

#include <Eigen/Dense>

// Dense decompositions, compiled once: Eigen's are instantiated in each source that uses them, the
// general eigenvalues alone at half a minute of the compiler. Large matrices are LAPACK's. Small
// ones, of whose figures users see many digits, are Eigen's: LAPACK rounds by the processor, and
// small shares of the energy of a mode then differ between machines by more than a billionth.
namespace blocklift::dynamics {

/// LU factorisation with partial pivoting of a large dense matrix of doubles or floats, by LAPACK.
template <class Real>
class DenseLu {
 public:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  DenseLu() = default;
  /// Takes the matrix and factorises it in place.
  /// @throws SimulationError if the matrix is singular; `what` says which matrix it is, `cause`
  ///   what that comes from.
  DenseLu(Matrix matrix, const char* what, const char* cause);

  Eigen::Index size() const { return factors_.rows(); }
  /// Replaces the right-hand sides by the solutions.
  void solve_in_place(Eigen::Ref<Matrix> right_sides) const;

 private:
  Matrix factors_;
  std::vector<int> pivots_;
};
extern template class DenseLu<double>;
extern template class DenseLu<float>;
using LuFactorisation = DenseLu<double>;

/// Replaces the right-hand sides by the solutions of a dense complex system, by LAPACK; large ones
/// leave a billionth of the right-hand sides at most. The matrix means nothing afterwards.
/// @throws SimulationError if the matrix is singular; `what` says which matrix it is.
void solve_in_place(Eigen::MatrixXcd& matrix, Eigen::MatrixXcd& right_sides, const char* what);

/// Eigenvalues, ascending, of a symmetric matrix, whose place its eigenvectors take as columns; by
/// LAPACK.
/// @throws SimulationError if the iteration does not converge.
Eigen::VectorXd decompose_symmetric(Eigen::MatrixXd& matrix);

/// Eigenvalues, ascending, of a Hermitian matrix, whose place its eigenvectors take as columns.
/// @throws SimulationError if the iteration does not converge.
Eigen::VectorXd decompose_hermitian(Eigen::MatrixXcd& matrix);

/// A V = V diag(values): eigenvalues of a square real matrix, pairs that are conjugate one behind
/// the other, and its right eigenvectors of length 1, one a column.
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
/// @throws SimulationError if the iteration does not converge.
Eigensystem decompose_general(const Eigen::MatrixXd& matrix);

/// A = U diag(values) V^T of an m x n matrix, without U.
struct RightSingularVectors {
  Eigen::VectorXd values;   ///< min(m, n), descending
  Eigen::MatrixXd vectors;  ///< V, n x n: its last columns span the null space
};
RightSingularVectors decompose_singular(const Eigen::MatrixXd& matrix);

/// Replaces the columns of a matrix, no more than its rows, by orthonormal ones that span the same
/// (Householder's, by LAPACK).
void orthonormalise(Eigen::MatrixXd& matrix);

/// C = alpha A B + beta C, by BLAS.
void multiply(double alpha, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double beta,
              Eigen::MatrixXd& C);
void multiply(float alpha, const Eigen::MatrixXf& A, const Eigen::MatrixXf& B, float beta,
              Eigen::MatrixXf& C);

}  // namespace blocklift::dynamics
