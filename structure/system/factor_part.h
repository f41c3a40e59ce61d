#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/packet.h"
#include "structure/system/cholesky_factor.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// A matrix restricted to the unknowns that one process eliminates and, after them, those of the
/// interface that it touches.
struct PartOfMatrix {
  SparseLower matrix;
  int inner = 0;  ///< unknowns to eliminate

  int boundary() const { return static_cast<int>(matrix.cols()) - inner; }
  void put_into(Packet& packet) const;
  static PartOfMatrix from(Packet& packet);
};

/// One process's share of a factorisation.
///
/// Of the part [K, B'; B, D] it finds C = B K^-1 B', which the elimination of its unknowns takes
/// from the interface. CholeskyFactor factorises whole matrices only: D + diag(D) is put in D's
/// place, which with it is positive definite since D - C is not negative, and then C is that less
/// L L' of the last rows of the factor. Its rounding is of the size of the diagonal's, as without.
class FactorPart {
 public:
  /// Analyses. @throws NotEnoughMemory
  explicit FactorPart(PartOfMatrix part);

  /// What it will take, bytes.
  double bytes() const;
  /// Factorises; returns -C, its lower triangle.
  /// @throws NotEnoughMemory; LooseUnknown, by the part's numbers
  Eigen::MatrixXd eliminate();
  /// Takes loads on the own unknowns, a column each; returns what they bring upon the interface.
  Eigen::MatrixXd forward(const Eigen::MatrixXd& loads);
  /// Takes the solution of the interface; returns that of the own unknowns for the last loads.
  Eigen::MatrixXd backward(const Eigen::MatrixXd& boundary) const;

 private:
  PartOfMatrix part_;
  std::unique_ptr<CholeskyFactor> factor_;  ///< none: nothing to eliminate
  Eigen::MatrixXd corner_;                  ///< last rows and columns of the factor
  Eigen::MatrixXd reduced_;                 ///< L^-1 of the last loads
};

}  // namespace blocklift::structure
