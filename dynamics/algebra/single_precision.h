#pragma once

#include <vector>

#include <Eigen/Dense>

// Dense algebra in single precision, most of it by LAPACK and BLAS: half the time and half the
// memory, where what follows from the figures is held in single precision anyway.
namespace blocklift::dynamics {

/// LU factorisation with partial pivoting of a large dense matrix in single precision.
class SingleLuFactorisation {
 public:
  SingleLuFactorisation() = default;
  /// Takes the matrix and factorises it in place.
  /// @throws SimulationError if the matrix is singular; `what` says which matrix it is, `cause`
  ///   what that comes from.
  SingleLuFactorisation(Eigen::MatrixXf matrix, const char* what, const char* cause);

  Eigen::Index size() const { return factors_.rows(); }
  /// Replaces the right-hand sides by the solutions.
  void solve_in_place(Eigen::MatrixXf& right_sides) const;

 private:
  Eigen::MatrixXf factors_;
  std::vector<int> pivots_;
};

/// C = alpha A B + beta C.
void multiply(float alpha, const Eigen::MatrixXf& A, const Eigen::MatrixXf& B, float beta,
              Eigen::MatrixXf& C);

/// Y = A X for a symmetric A of which both halves are stored. One column reads only half of A. The
/// figures do not depend on the number of threads.
void multiply_symmetric(const Eigen::MatrixXf& A, const Eigen::MatrixXf& X, Eigen::MatrixXf& Y);

}  // namespace blocklift::dynamics
