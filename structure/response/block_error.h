#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/elastic_model.h"

namespace blocklift::structure {

/// Stress error of a block's displacement by recovery, in the energy norm.
///
/// The stresses of each cell at its p x p x p Gauss points, where elements of degree p are most accurate
/// (Barlow 1976), are carried to its nodes by the polynomials through these points and averaged there over
/// the cells of one plate: the recovered stress s*, which is as smooth as the displacement. With s_h the
/// elements' own stress |e|^2 = int (s* - s_h) : C^-1 : (s* - s_h) dV. Columns where plates cross are
/// averaged for themselves.
/// Source: Zienkiewicz and Zhu (1987), Int. J. Numer. Methods Eng. 24, 337-357, with the local smoothing of
/// Hinton and Campbell (1974).
struct BlockError {
  double relative = 0;  ///< |e| over the square root of |e|^2 + |s_h|^2, of the whole block
  /// The same of each group of cells, in the order of HexMesh::groups.
  std::vector<double> of_groups;
  std::string worst_part;  ///< the single plate that holds the cell with the largest |e|
  Vector3 worst_point = Vector3::Zero();  ///< that cell's centre, m
};

/// @param displacement 3 a node, m.
BlockError estimate_block_error(const ElasticModel& model, const Eigen::VectorXd& displacement,
                                int threads = 0);

}  // namespace blocklift::structure
