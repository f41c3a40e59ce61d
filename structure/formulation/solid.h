#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/space/space.h"

namespace blocklift::structure {

/// A point of a solid with what it feels of the solid's nodes.
struct SolidPoint {
  double weight = 0;           ///< volume that it stands for, m^3
  Eigen::VectorXd values;      ///< N_i
  Eigen::Matrix3Xd gradients;  ///< d N_i / dx along the block's axes, 1/m
};

/// Integration points of a solid of the mesh, exact for its stiffness where its edges are straight
/// and its faces parallel: 27 of a hexahedron, 10 of a tetrahedron, 18 of a wedge at least.
std::vector<SolidPoint> solid_points(const Mesh& mesh, const Solid& solid);

/// Stiffness of a quadratic isoparametric solid, freedoms in the order of Space::element_freedoms
/// (Zienkiewicz, Taylor, Zhu, 2013, chapter 6), N/m.
Eigen::MatrixXd solid_stiffness(const Mesh& mesh, const Solid& solid);

/// Stresses at a solid's corners for motions (freedoms x m): row 6 corner + component (xx, yy, zz,
/// xy, yz, zx along the block's axes), Pa. They are a least-squares fit, linear along the local
/// coordinates, through the integration points, where the stresses of such elements are best
/// (Barlow, 1976).
Eigen::MatrixXd solid_corner_stresses(const Space& space, int solid,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions);

}  // namespace blocklift::structure
