#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "structure/system/linear_solver.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// A weighted sum of unknowns that a support holds: sum_j r_j q_j = value.
struct HeldSum {
  std::map<int, double> coefficients;  ///< r, by unknown
  double value = 0;                    ///< m or rad
};

/// K q = f with sums of unknowns held, factorised once for any number of load vectors.
///
/// Supports hold displacements along axes of their own and what follows others through links, so
/// that a held sum may have several unknowns. Of each, the unknown with the largest coefficient is
/// eliminated, q = Z q' + q_0 (Gauss and Jordan), and Z' K Z q' = Z' (f - K q_0) is solved. The
/// forces of the supports are those multipliers of least sum of squares for which
/// K q - f = R' lambda.
class HeldSystem {
 public:
  /// @throws ModelError if sums contradict each other, or memory does not suffice.
  HeldSystem(SparseLower stiffness, std::vector<HeldSum> sums);
  ~HeldSystem();

  /// @throws LooseUnknown if the supports leave a mechanism.
  void factorise();
  /// All unknowns for load vectors, a column each.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& loads) const;
  /// Forces along the sums, which the supports exert: a row a sum, a column a load vector.
  Eigen::MatrixXd reactions(const Eigen::MatrixXd& solution, const Eigen::MatrixXd& loads) const;
  /// Strain energy of a solution, J.
  double energy(const Eigen::VectorXd& solution) const;

 private:
  void eliminate();
  void make_map();
  SparseLower reduced_stiffness() const;

  SparseLower stiffness_;
  std::vector<HeldSum> sums_;
  std::map<int, HeldSum> eliminated_;  ///< q of the key is value less the sum of the others
  SparseLower map_;                    ///< Z
  Eigen::VectorXd offset_;             ///< q_0
  std::optional<ConstrainedSystem> system_;
};

}  // namespace blocklift::structure
