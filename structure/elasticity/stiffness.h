#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "structure/elasticity/discretisation.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Stiffness of single cells,
///   K_ia,jb = int lambda d_a N_i d_b N_j + mu (d_b N_i d_a N_j + delta_ab grad N_i . grad N_j) dV,
/// unknown 3 i + a of the cell being component a of its node i.
/// Source: Zienkiewicz, Taylor, Zhu (2013), chapter 6.
///
/// Gauss points: degree + 1 along each axis, exact for cells with constant Jacobian. For those the
/// integrals over the unit cube are computed once and scaled.
class CellStiffness {
 public:
  CellStiffness(const HexMesh& mesh, const Discretisation& space);

  /// Stiffness of a cell, N/m, 3 nodes_per_cell square. May be called from several threads.
  Eigen::MatrixXd operator()(int cell) const;

 private:
  const HexMesh& mesh_;
  const Discretisation& space_;
  Eigen::Matrix4Xd rule_;
  Eigen::MatrixXd gradients_;                    ///< by unit coordinates at the Gauss points
  std::array<Eigen::MatrixXd, 9> on_unit_cube_;  ///< int d_a N_i d_b N_j, entry 3 a + b
};

/// Stiffness of the whole mesh, N/m. Cells of one shape and material are integrated once; columns
/// are dealt out to `threads` threads, so that none writes where another does.
SparseLower assemble_stiffness(const HexMesh& mesh, const Discretisation& space, int threads);

/// Number of entries that assemble_stiffness will store.
long stiffness_entries(const Discretisation& space);

}  // namespace blocklift::structure
