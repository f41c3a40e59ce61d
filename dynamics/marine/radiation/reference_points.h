#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// The same database with each body's rotations and moments about another point of it (m, in W, one
/// for each body). With a = r - p from the new point p to the old one r,
///
///   v_r = v_p + omega x a,   M_p = M_r + a x F,
///
/// all matrices become T^T M T, all forces T^T F, T being the unit matrix but for -[a x] in each
/// body's displacements by rotation. The stiffness follows the same rule, as a body at rest has no
/// force left. Of a mean drift in surge, sway and yaw alone, yaw follows, and no moments of heel
/// are made up. Estimates of errors and the far field, which are about the old points, are left
/// out; a body whose point stays keeps its figures to the last digit.
/// @throws ModelError unless there is a point for each body.
HydrodynamicDatabase about_points(HydrodynamicDatabase database,
                                  const std::vector<Vector3>& points);

}  // namespace blocklift::dynamics
