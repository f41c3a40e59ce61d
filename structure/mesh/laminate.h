#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "structure/material.h"
#include "structure/mesh/heat.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Material of one layer in plane stress, in axes of its own.
struct PlyMaterial {
  /// sigma = in_plane (epsilon_11, epsilon_22, gamma_12), Pa
  Eigen::Matrix3d in_plane = Eigen::Matrix3d::Zero();
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();      ///< G_13, G_23, Pa
  double density = 0;                                   ///< kg/m^3
  Eigen::Vector3d expansion = Eigen::Vector3d::Zero();  ///< 11, 22 and 12 (twice), 1/K
};

PlyMaterial isotropic_ply(const Material& material);

/// E_1, E_2, nu_12, G_12 as usual for unidirectional layers. Jones (1999), equation 2.70.
PlyMaterial orthotropic_ply(double modulus_1, double modulus_2, double poisson_12, double shear_12,
                            double shear_13, double shear_23, double density);

/// Layer of a plate; from the bottom up, the normal pointing up.
struct Ply {
  PlyMaterial material;
  double thickness = 0;  ///< m
  double angle = 0;      ///< of its axis 1 from the plate's, rad, about the normal
};

/// Plane-stress stiffness seen from axes turned by -angle. Jones (1999), equation 2.85.
Eigen::Matrix3d turned(const Eigen::Matrix3d& in_plane, double angle);

/// Stiffness of bonded layers about the middle of their height.
///
/// A, B, D integrate the layers' stiffness (Jones 1999, equations 4.24). Across the plate, the
/// shear stress follows from equilibrium in cylindrical bending about each axis,
///   tau(z) = -1/(E I) int_bottom^z Q_11 (z - z_n) dz,  1/S = int tau^2 / G dz,
/// which gives 5/6 G t for one layer, and the core's G (d^2 / c) for a sandwich with thin faces.
Laminate stack(const std::vector<Ply>& plies);

/// How bonded layers expand, about the middle of their height. References and obstacles are not of
/// layers and stay as they are.
LaminateExpansion expansion_of(const std::vector<Ply>& plies);

/// The same of a plate of one isotropic material.
LaminateExpansion expansion_of(const Material& material, const MaterialExpansion& expansion,
                               double thickness);

/// Isotropic plate that comes nearest to a laminate of a thickness: its membrane stiffness has the
/// laminate's invariants (Tsai and Pagano 1968), so that it is exact for layers of one material and
/// for balanced lay-ups. Poisson's ratio is no more than 0.49.
struct NearestPlate {
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  /// Largest difference of A, of D and of S, relative to the largest entry of each, and of B to
  /// that of A times half the thickness.
  double membrane_error = 0, bending_error = 0, shear_error = 0, coupling_error = 0;

  bool is_exact(double tolerance = 1e-6) const {
    return membrane_error < tolerance && bending_error < tolerance && shear_error < tolerance &&
           coupling_error < tolerance;
  }
};

NearestPlate nearest_plate(const Laminate& laminate, double thickness);

/// The coefficient with which the nearest plate of a thickness expands as a laminate does; none if
/// no coefficient does.
std::optional<double> even_coefficient(const LaminateExpansion& expansion,
                                       const NearestPlate& nearest, double thickness);

/// Stiffness of a plate of one isotropic material, as a laminate.
Laminate homogeneous(const Material& material, double thickness);

}  // namespace blocklift::structure
