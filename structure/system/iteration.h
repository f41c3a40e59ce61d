#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/process_group.h"
#include "structure/system/linear_solver.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// What an iteration has come to.
struct Iterated {
  Eigen::VectorXd displacements;
  Eigen::VectorXd reactions;  ///< of the supports, one a fixed unknown: (K u - f) there, N
  int iterations = 0;
};

/// Solves K u = f with some displacements given, three unknowns a node, in a fraction of the memory
/// of a factor: by conjugate gradients with smoothed aggregation, an algebraic multigrid method
/// which is given the six rigid motions (Vanek, Mandel, Brezina, 1996), by PETSc. Where a
/// FactorTeam lives, its processes share the rows.
/// @param rigid_motions six columns, a row an unknown, m.
/// @param tolerance residual over load.
/// @throws ModelError if it does not converge.
Iterated solve_by_iteration(const SparseLower& stiffness, const std::vector<FixedUnknown>& fixed,
                            const Eigen::VectorXd& load, const Eigen::MatrixXd& rigid_motions,
                            double tolerance);

/// What the other processes do meanwhile.
void follow_iteration(const ProcessGroup& group);

}  // namespace blocklift::structure
