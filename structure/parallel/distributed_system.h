#pragma once

#include <string>

#include <Eigen/Core>

#include "structure/parallel/part_share.h"
#include "structure/part/part_solution.h"
#include "structure/process_group.h"

namespace blocklift::structure {

/// What one process knows of a distributed solution.
struct ShareSolution {
  Eigen::VectorXd displacement;  ///< 3 a node of the share, halo included, m
  SolverAccount account;         ///< the same on all processes
};

/// Solves K u = f, each process holding a share of the rows; all processes of the group call this.
///
/// Direct: Cholesky factorisation by MUMPS. Iterative: conjugate gradients with smoothed
/// aggregation, an algebraic multigrid method which is given the six rigid motions (Vanek, Mandel,
/// Brezina, 1996), by PETSc. Left to choose, it takes the direct way if MUMPS' own estimate of its
/// memory fits.
/// @throws ModelError on all processes alike: the memory does not suffice, the stiffness is not
///   positive definite, the iteration does not converge.
ShareSolution solve_share(const ProcessGroup& group, const PartShare& share,
                          const SolverChoice& choice);

}  // namespace blocklift::structure
