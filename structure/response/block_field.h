#pragma once

#include <Eigen/Core>

#include "structure/elasticity/elastic_model.h"

namespace blocklift::structure {

/// A place within a cell of a block.
struct CellPlace {
  int cell = -1;  ///< -1: in no cell
  Vector3 xi = Vector3::Zero();
};

/// The cell that holds a place (m; to 1e-6 of the cell's own coordinates), the first in order of cells.
CellPlace find_cell(const HexMesh& mesh, const Vector3& place);

/// Displacements at places of a block: row 3 p + axis for place p, a column for each of `displacements`
/// (unknowns x m), m. @throws ModelError naming the first place that lies in no cell.
Eigen::MatrixXd displacements_at(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                                 const Eigen::Matrix3Xd& places);

/// Stresses at a place in a cell, row a component (xx, yy, zz, xy, yz, zx), a column for each of
/// `displacements`, Pa.
Eigen::MatrixXd stresses_at(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                            const CellPlace& place);

}  // namespace blocklift::structure
