#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

namespace blocklift::dynamics {

/// LU factorisation with partial pivoting of a large dense matrix, by LAPACK.
class LuFactorisation {
 public:
  LuFactorisation() = default;
  /// Takes the matrix and factorises it in place.
  /// @throws SimulationError if the matrix is singular; `what` says which matrix it is.
  LuFactorisation(Eigen::MatrixXd matrix, const char* what);

  Eigen::Index size() const { return factors_.rows(); }
  /// Replaces the right-hand sides by the solutions.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const;

 private:
  Eigen::MatrixXd factors_;
  std::vector<int> pivots_;
};

/// Replaces the right-hand sides by the solutions of a dense complex system, of whose matrix
/// nothing is left, by LAPACK.
/// @throws SimulationError if the matrix is singular; `what` says which matrix it is.
void solve_in_place(Eigen::MatrixXcd& matrix, Eigen::MatrixXcd& right_sides, const char* what);

/// Eigenvalues, ascending, of a symmetric matrix, whose place its eigenvectors take as columns; by
/// LAPACK.
/// @throws SimulationError if the iteration does not converge.
Eigen::VectorXd decompose_symmetric(Eigen::MatrixXd& matrix);

/// C = alpha A B + beta C, by BLAS.
void multiply(double alpha, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double beta,
              Eigen::MatrixXd& C);

/// Y = A X for a symmetric A of which both halves are stored, in single precision, by BLAS: one
/// column reads only half of A.
void multiply_symmetric(const Eigen::MatrixXf& A, const Eigen::MatrixXf& X, Eigen::MatrixXf& Y);

/// Calls work(i) for 0 <= i < count, shared out among threads (0: one a core). The first exception
/// thrown by any of them is thrown on.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

}  // namespace blocklift::dynamics
