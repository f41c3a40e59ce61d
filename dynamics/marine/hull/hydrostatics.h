#pragma once

#include "dynamics/marine/hull/hull_clusters.h"
#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// What still water with its surface at z = 0 of the world does to a hull at one pose.
///
/// Everything is exact for the polyhedron: its triangles are cut by the plane, and Gauss' theorem
/// turns volumes and water-plane integrals into integrals over the wetted surface. With the height
/// h of a point above the water (u: the world's z axis) and n out of the body,
///
///   V = int h u.n dA,   F = rho g int h n dA = rho g V u,   M_Bo = rho g int h p x n dA,
///   A_w = -int u.n dA,  U = -rho g int_V h dV = -rho g/2 int h^2 u.n dA.
///
/// F and M are minus the derivative of U with respect to the pose, so that no work is done round a
/// closed path. Out of the water all is zero; under water nothing depends on the depth but U.
/// Source: paper eq. (19); Newman, Marine Hydrodynamics (1977), sec. 6.16.
struct Hydrostatics {
  double volume = not_a_number;                               ///< displaced, m3
  Vector3 volume_moment_W = Vector3::Constant(not_a_number);  ///< int (p_WP - p_WBo) dV in W, m4
  double energy_over_rho_g = not_a_number;  ///< U / (rho g): -int z dV, m4, never negative
  double water_plane_area = not_a_number;   ///< A_w, m2
  /// int x dA, int y dA over the water plane, x and y along W's axes from Bo, m3.
  Eigen::Vector2d water_plane_moment = Eigen::Vector2d::Constant(not_a_number);
  /// int xx dA, int xy dA, int yy dA over the water plane, about Bo, m4.
  Vector3 water_plane_second_moment = Vector3::Constant(not_a_number);

  /// Buoyancy about Bo in W over rho g: force (0, 0, V), moment (S_y, -S_x, 0), S =
  /// volume_moment_W.
  ForceVector force_over_rho_g() const {
    return {{volume_moment_W.y(), -volume_moment_W.x(), 0.0}, {0.0, 0.0, volume}};
  }
  /// Centre of buoyancy from Bo in W, m; NaN out of the water.
  Vector3 p_BoC_W() const { return volume_moment_W / volume; }
};

/// Evaluates a hull at the pose X_WB. Does not allocate.
Hydrostatics calc_hydrostatics(const HullClusters& hull, const Pose& X_WB);

/// Buoyancy alone, about Bo in W over rho g, and the energy: cheaper where no water-plane is asked
/// for. It is force_over_rho_g() of the above. Does not allocate.
struct Buoyancy {
  ForceVector F_Bo_W_over_rho_g;
  double energy_over_rho_g = not_a_number;  ///< m4
};
Buoyancy calc_buoyancy(const HullClusters& hull, const Pose& X_WB);

/// Displaced volume alone, m3: cheaper still. Does not allocate.
double calc_displaced_volume(const HullClusters& hull, const Pose& X_WB);

/// Exact derivative of the buoyancy about Bo: dF_Bo_W = -rho g K dX where dX = (rotation;
/// displacement of Bo), both small and in W, and dF = (moment; force). K in m3, m2 and m4; it is
/// symmetric but for the columns of yaw, since a moment that turns with the body has no potential.
Eigen::Matrix<double, 6, 6> calc_stiffness_over_rho_g(const Hydrostatics& hydrostatics);

/// Metacentric properties of an attitude, about the horizontal axes of W.
struct Metacentre {
  double KB = not_a_number;  ///< height of the centre of buoyancy above Bo, m
  double BM_x =
      not_a_number;  ///< I / V for rotation about W's x axis (transverse if x is forward), m
  double BM_y = not_a_number;  ///< and about W's y axis, m
  double GM_x = not_a_number;  ///< KB + BM_x - height of the centre of mass above Bo, m
  double GM_y = not_a_number;  ///< m
};
Metacentre calc_metacentre(const Hydrostatics& hydrostatics, const Vector3& p_BoBcm_W);

}  // namespace blocklift::dynamics
