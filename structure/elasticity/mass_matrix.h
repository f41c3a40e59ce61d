#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "structure/elasticity/part_model.h"
#include "structure/system/sparse_matrix.h"

namespace blocklift::structure {

/// Consistent mass by nodes, m_ij = int rho N_i N_j dV, kg: the lower triangle. The mass matrix of
/// the unknowns 3 n + a is this one for each axis a.
using NodalMass = SparseLower;

/// Consistent mass of a part, by the elements' own rules (exact for straight elements).
NodalMass part_mass_matrix(const PartModel& model);

/// M v for columns v of displacements (3 a node).
Eigen::MatrixXd mass_times(const NodalMass& mass, const Eigen::Ref<const Eigen::MatrixXd>& columns);

}  // namespace blocklift::structure
