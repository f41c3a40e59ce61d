#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/part/part_solution.h"

namespace blocklift::structure {

/// Stress error of a solution by superconvergent patch recovery, in the energy norm.
///
/// About each corner node, and within one material, a polynomial of the elements' order is fitted
/// to the stresses at those points of the elements around it where they are most accurate (Barlow's
/// points); these polynomials, averaged where several reach a node, are the recovered stress s*.
/// With s_h the elements' own stress, |e|^2 = int (s* - s_h) : C^-1 : (s* - s_h) dV. Source:
/// Zienkiewicz and Zhu (1992), Int. J. Numer. Methods Eng. 33, 1331-1364 and 1365-1382.
struct PartError {
  Eigen::VectorXd squared_error;  ///< |e|^2 of each solid, J
  Eigen::VectorXd squared_norm;   ///< int s_h : C^-1 : s_h dV of each solid, J
  /// The recovered stress at the points of PartStress, Pa; empty for a true error.
  Eigen::Matrix<double, 6, Eigen::Dynamic> recovered;
  /// |e| over the square root of the sum of both over some solids.
  double relative(const std::vector<int>& solids) const;
};

/// @param displacement 3 a node, m.
PartError estimate_part_error(const PartModel& model, const PartStress& stress,
                              const Eigen::VectorXd& displacement);

/// The same with a stress that is known (Pa, at a place in m) in the place of the recovered one:
/// the true error of a solution.
PartError true_part_error(const PartModel& model, const Eigen::VectorXd& displacement,
                          const std::function<Eigen::Matrix<double, 6, 1>(const Vector3&)>& exact);

}  // namespace blocklift::structure
