#pragma once

#include "dynamics/marine/hull/hydrostatics.h"

namespace blocklift::dynamics {

/// A rigid body in still water.
struct FloatingBody {
  double mass = not_a_number;                           ///< kg
  Vector3 p_BoBcm_B = Vector3::Constant(not_a_number);  ///< centre of mass from Bo in B, m
  double water_density = 1025.0;                        ///< kg/m3
};

/// How a body floats at rest.
struct FloatingPosition {
  Pose X_WB;                  ///< the water surface is z = 0
  Hydrostatics hydrostatics;  ///< at that pose
  /// Smallest stiffness against heel and trim, sinkage free, over weight: m, a metacentric height
  /// about the least stable axis. Positive: the position is stable.
  double least_metacentric_height = not_a_number;
};

/// Height of Bo at which the hull, turned by R_WB, displaces a volume (m3).
/// @throws ModelError if the hull cannot displace so much.
double find_floating_height(const HullClusters& hull, const Matrix3& R_WB, double volume);

/// Stable position of equilibrium that a freely floating body settles in from the attitude R_WB.
///
/// For each attitude the body first takes the height at which buoyancy carries its weight; heel and
/// trim then follow the descent of the potential energy (Newton's method with the exact stiffness,
/// its negative eigenvalues reversed, and a line search), so that an unstable balance is left. Yaw
/// stays as it is given, up to the turning that heel and trim bring with them.
/// @throws ModelError if mass or density is not positive or the body is heavier than the water that
///   the whole hull displaces (the message has both figures).
/// @throws SimulationError if no equilibrium is found.
FloatingPosition find_floating_position(const HullClusters& hull, const FloatingBody& body,
                                        const Matrix3& R_WB = Matrix3::Identity());

/// One point of a curve of righting arms.
struct RightingArm {
  double heel = not_a_number;    ///< phi, rad
  double trim = not_a_number;    ///< theta, rad; positive: the bow (+x) down
  double height = not_a_number;  ///< of Bo above the water, m
  double GZ = not_a_number;      ///< righting moment over weight, m; positive: turns back
};

/// Righting arms at given angles of heel (rad, any from -pi to pi), the body free to sink and to
/// trim: R_WB = Ry(theta) Rx(phi) with theta such that no moment acts about the level axis y. The
/// trim is followed from angle to angle.
/// @throws as find_floating_position.
std::vector<RightingArm> calc_righting_arms(const HullClusters& hull, const FloatingBody& body,
                                            const std::vector<double>& heels);

}  // namespace blocklift::dynamics
