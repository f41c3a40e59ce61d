#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/formulation/cell_heat.h"
#include "structure/mesh/part_mesh.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A point of a solid with what it feels of the solid's nodes.
struct SolidPoint {
  double weight = 0;           ///< volume that it stands for, m^3
  Vector3 place;               ///< m
  Eigen::VectorXd values;      ///< N_i
  Eigen::Matrix3Xd gradients;  ///< d N_i / dx along the world's axes, 1/m
};

/// The points of the kind's rule in an isoparametric solid.
/// @param places of its nodes, 3 x nodes, m.
std::vector<SolidPoint> solid_points(const ElementKind& kind, const Eigen::Matrix3Xd& places);

/// Stiffness of a solid, N/m: unknown 3 i + a is the displacement of its node i along axis a.
///   K_ia,jb = int lambda d_a N_i d_b N_j + mu (d_b N_i d_a N_j + delta_ab grad N_i . grad N_j) dV
/// Source: Zienkiewicz, Taylor, Zhu (2013), chapter 6.
Eigen::MatrixXd solid_stiffness(const ElementKind& kind, const Eigen::Matrix3Xd& places,
                                const Material& material);

/// The same of any elasticity along the world's axes: K = int B' C B dV.
Eigen::MatrixXd solid_stiffness(const ElementKind& kind, const Eigen::Matrix3Xd& places,
                                const Elasticity& elasticity);

/// Consistent mass of a solid, kg, unknowns as in the stiffness: int rho N_i N_j dV for each axis.
Eigen::MatrixXd solid_mass(const ElementKind& kind, const Eigen::Matrix3Xd& places, double density);

/// The same of a solid of a mesh; the stiffness' freedoms are in the order of
/// Space::element_freedoms.
std::vector<SolidPoint> solid_points(const Mesh& mesh, const Solid& solid);
Eigen::MatrixXd solid_stiffness(const Mesh& mesh, const Solid& solid);

/// Stresses at a solid's integration points for motions (freedoms x m): row 6 point + component
/// (xx, yy, zz, xy, yz, zx along the block's axes), Pa.
/// @param heat of as many cases as there are motions; null: none.
Eigen::MatrixXd solid_stresses(const Space& space, int solid,
                               const Eigen::Ref<const Eigen::MatrixXd>& motions,
                               const CellHeat* heat = nullptr);

/// Stresses at a solid's corners for motions (freedoms x m): row 6 corner + component (xx, yy, zz,
/// xy, yz, zx along the block's axes), Pa. They are a least-squares fit, linear along the local
/// coordinates, through the integration points, where the stresses of such elements are best
/// (Barlow, 1976).
Eigen::MatrixXd solid_corner_stresses(const Space& space, int solid,
                                      const Eigen::Ref<const Eigen::MatrixXd>& motions,
                                      const CellHeat* heat = nullptr);

}  // namespace blocklift::structure
