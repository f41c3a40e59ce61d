#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "structure/formulation/solid_set.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

/// Points at the nodes of solids: one for each node and law of solids that meet it, since stress
/// jumps between materials.
struct NodalPoints {
  std::vector<int> node;      ///< of each point
  std::vector<int> point_of;  ///< point of each node of each solid, solids after one another
  std::vector<int> first_of;  ///< place in point_of of each solid's first node
};

NodalPoints find_nodal_points(const SolidSet& solids);

/// Stress error of solids by superconvergent patch recovery, in the energy norm.
///
/// About each corner node, and within one law, a polynomial of the elements' order is fitted to the
/// stresses at those points of the elements around it where they are most accurate (Barlow's
/// points); these polynomials, averaged where several reach a node, are the recovered stress s*.
/// With s_h the elements' own stress, |e|^2 = int (s* - s_h) : C^-1 : (s* - s_h) dV. Source:
/// Zienkiewicz and Zhu (1992), Int. J. Numer. Methods Eng. 33, 1331-1364 and 1365-1382.
struct SolidError {
  Eigen::VectorXd squared_error;  ///< |e|^2 of each solid, J
  Eigen::VectorXd squared_norm;   ///< int s_h : C^-1 : s_h dV of each solid, J
  StressColumns recovered;        ///< s* at the nodal points, Pa; empty for a true error
  /// |e| over the square root of the sum of both over some solids.
  double relative(const std::vector<int>& solids) const;
};

/// Stresses that a displacement's are to be lessened by, Pa: those that hold a hot solid (CellHeat)
/// at points where its shape functions (points x nodes) are given, 6 x points. Empty: none.
using HeldSolidStress = std::function<StressColumns(int solid, const Eigen::MatrixXd& values)>;

/// @param displacement 3 a node, m. @param threads 0: as many as the machine has.
SolidError estimate_solid_error(const SolidSet& solids, const NodalPoints& points,
                                const Eigen::VectorXd& displacement, int threads = 0,
                                const HeldSolidStress& held = {});

/// The same with a stress that is known (Pa, at a place in m) in the place of the recovered one:
/// the true error of a solution.
SolidError true_solid_error(const SolidSet& solids, const Eigen::VectorXd& displacement,
                            const std::function<Stress(const Vector3&)>& exact);

}  // namespace blocklift::structure
