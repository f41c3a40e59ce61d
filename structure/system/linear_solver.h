#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/error.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Unknown whose displacement is given.
struct FixedUnknown {
  int unknown = 0;
  double value = 0;  ///< m
};

/// Nothing resists an unknown: the matrix is not positive definite, or so little that what resists
/// it is rounding.
class LooseUnknown : public ModelError {
 public:
  LooseUnknown(const std::string& message, int the_unknown)
      : ModelError(message), unknown(the_unknown) {}
  int unknown;  ///< one of those that move
};

/// K u = f with some displacements given, factorised once for any number of load vectors.
///
/// Sparse supernodal Cholesky (CholeskyFactor) in the order of the unknowns, which an
/// Elimination has chosen by nested dissection.
class ConstrainedSystem {
 public:
  /// Takes the stiffness over and analyses it; nothing is factorised yet.
  /// @throws ModelError if the factor would not fit into the memory that is free.
  ConstrainedSystem(SparseLower&& stiffness, std::vector<FixedUnknown> fixed);
  ~ConstrainedSystem();

  /// Memory that the factor will take, bytes.
  double factor_bytes() const;
  /// Factorises and gives the stiffness free.
  /// @throws LooseUnknown if the matrix is not positive definite but for rounding: the supports
  ///   leave a mechanism.
  void factorise();
  /// Displacements for load vectors (one a column; entries at fixed unknowns do not matter).
  Eigen::MatrixXd solve(Eigen::MatrixXd loads) const;
  /// The same with displacements of the fixed unknowns that are given here, not by
  /// FixedUnknown::value: a row a fixed unknown, a column a load vector, m.
  Eigen::MatrixXd solve(Eigen::MatrixXd loads, const Eigen::MatrixXd& given) const;
  /// Forces that the supports exert, one row a fixed unknown: (K u - f) there, N.
  Eigen::MatrixXd reactions(const Eigen::MatrixXd& displacements,
                            const Eigen::MatrixXd& loads) const;
  const std::vector<FixedUnknown>& fixed() const { return fixed_; }

 private:
  struct Factor;
  void separate_fixed();

  SparseLower stiffness_;
  std::vector<FixedUnknown> fixed_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, long> fixed_rows_;  ///< of the full stiffness
  std::unique_ptr<Factor> factor_;
};

/// Memory that is free on this machine, bytes; infinity where it cannot be told.
double available_memory();

/// The same where so many bytes are wanted: what was freed and is still held goes back first if it
/// takes that to have them.
double memory_for(double bytes);

}  // namespace blocklift::structure
