#pragma once

#include <vector>

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics {

/// Factor L of the mass matrix of the free velocities, M = L^T L, that has the sparsity of the
/// tree: row i of the lower triangle L has entries at i and at the velocities between i and the
/// world only. Driven velocities are left out. Source: Featherstone (2008), section 6.5 (LTL).
///
/// Bodies that an inertia ties together (AddedInertia) are made a chain for the purpose: the
/// velocities that move any of them count as lying between the world and those of a higher index,
/// and between the world and all that these bodies carry. The entries that the tie makes are then
/// within the sparsity.
class MassFactor {
 public:
  /// @param tied bodies whose velocities are tied to one another by inertia besides the tree's.
  explicit MassFactor(const Mechanism& mechanism, const std::vector<BodyIndex>& tied = {});

  Eigen::Index size() const { return static_cast<Eigen::Index>(depth_.size()); }

  /// @param mass_matrix nv x nv (compute_mass_matrix). Does not allocate.
  /// @throws SimulationError if nothing resists some free velocity, naming the body.
  void factorise(const Mechanism& mechanism, const Eigen::Ref<const Eigen::MatrixXd>& mass_matrix);

  /// x <- L^-T x.
  void solve_transposed(VectorRef x) const;
  /// x <- L^-1 x.
  void solve(VectorRef x) const;
  /// B <- B L^-1 for a matrix of rows g^T (any number of rows x size()).
  void solve_rows(Eigen::Ref<Eigen::MatrixXd> rows) const;

 private:
  const double* row(std::size_t i) const { return values_.data() + offset_[i]; }
  double* row(std::size_t i) { return values_.data() + offset_[i]; }
  const int* ancestors(std::size_t i) const { return ancestors_.data() + offset_[i]; }

  // Of free velocity i: depth_[i] free velocities lie between it and the world, listed from the
  // world on and ended by i itself; the entries of its row stand in the same order. The ancestors
  // of an ancestor are then the first part of the list.
  std::vector<std::size_t> depth_;
  std::vector<std::size_t> offset_;
  std::vector<int> ancestors_;
  std::vector<double> values_;
};

}  // namespace blocklift::dynamics
