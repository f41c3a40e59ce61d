#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Stress error of a block's motion by recovery, in the energy norm of all its strains.
///
/// Membrane forces and moments of each shell cell at its p x p Gauss points, where elements of
/// degree p are most accurate (Barlow 1976), are carried to its nodes by the polynomials through
/// these points and averaged there over the cells of one field of plating, which goes on across
/// kinks of up to 46 degrees: the recovered resultants, as smooth as the motion. With e the
/// difference to the elements' own resultants, |e|^2 = int e : law^-1 : e dA; the law of layers is
/// their own. Source: Zienkiewicz and Zhu (1987), Int. J. Numer. Methods Eng. 24, 337-357, with the
/// local smoothing of Hinton and Campbell (1974).
/// The recovered drilling is nothing. Of triangles transverse shear counts, too, recovered by its
/// balance with the recovered moments.
/// That of solids is SolidError's. Bars have none: their elements of degree 3 hold what evenly
/// spread and end loads do.
struct BlockError {
  /// |e| over the square root of |e|^2 + |s_h|^2, of the whole block; of triangles over the larger
  /// of |s_h| and of the norm of what is recovered: triangles that lock have much that is no part
  /// of it.
  double relative = 0;
  double squared_norm = 0;  ///< |s_h|^2 + |e|^2, twice an energy, J
  /// The same of each group of cells, in the order of Mesh::groups.
  std::vector<double> of_groups;
  /// The region that holds the cell or solid with the largest |e|; empty: there is none.
  std::string worst_part;
  Vector3 worst_point = Vector3::Zero();  ///< its centre, m
  Eigen::VectorXd of_cells;               ///< |e|^2 of each of Space::shells(), J
};

/// Of each motion, a column: what belongs to the cells alone is computed once for several.
/// @param motions six a node. @param heat of as many cases as there are motions; null: none.
std::vector<BlockError> estimate_block_errors(const ElasticModel& model,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                              int threads = 0, const CellHeat* heat = nullptr);
/// The same of one.
BlockError estimate_block_error(const ElasticModel& model, const Eigen::VectorXd& motion,
                                int threads = 0);

}  // namespace blocklift::structure
