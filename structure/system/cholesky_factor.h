#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Neighbouring columns of a factor that have the same rows below them.
struct Supernode {
  long first = 0;    ///< column
  long columns = 0;  ///< how many
  long rows = 0;     ///< of the first column, its diagonal included
  int parent = -1;   ///< supernode of the next row below; -1: there is none
};

/// K = L L' of a symmetric, positive definite sparse matrix by supernodal Cholesky factorisation,
/// in the order of the unknowns; CHOLMOD finds the pattern of L. Neither L nor solutions depend on
/// the number of threads.
class CholeskyFactor {
 public:
  /// Finds the pattern of L. @throws NotEnoughMemory
  explicit CholeskyFactor(const SparseLower& matrix);
  ~CholeskyFactor();
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;

  /// Memory that L takes, bytes.
  double bytes() const;
  std::vector<Supernode> supernodes() const;

  /// @param matrix of the pattern that was analysed.
  /// @param held stiffness of each unknown with all others held, which tells what of its pivot is
  ///   rounding.
  /// @param threads 0: as many as are usable.
  /// @throws NotEnoughMemory; LooseUnknown if the matrix is not positive definite but for rounding.
  void factorise(const SparseLower& matrix, const Eigen::VectorXd& held, int threads = 0);

  /// x of K x = f, a column a load vector.
  Eigen::MatrixXd solve(Eigen::MatrixXd loads) const;
  /// y of L y = f.
  Eigen::MatrixXd solve_lower(Eigen::MatrixXd loads) const;
  /// x of L' x = y.
  Eigen::MatrixXd solve_upper(Eigen::MatrixXd reduced) const;
  /// Rows and columns of L from `first` on, zeros above the diagonal.
  Eigen::MatrixXd corner(long first) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace blocklift::structure
