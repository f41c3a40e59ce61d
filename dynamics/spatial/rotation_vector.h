#pragma once

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// How the rotation vector theta of a rotation R (rad, shorter than a whole turn) changes by a
/// small turn of R from the left, exp(turn) R: the inverse of the left Jacobian of SO(3)
/// (Chirikjian 2012, section 10.2).
Matrix3 inverse_left_jacobian(const Vector3& theta);

}  // namespace blocklift::dynamics
