#pragma once

#include <Eigen/Core>

#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

using Vector3 = Eigen::Vector3d;

/// A point or displacement `[x, y, z]` of three lengths, m.
Format<Vector3> position_format();

/// A size `[length, width, height]` of three positive lengths, m.
Format<Vector3> size_format();

/// A direction `[x, y, z]` of three plain numbers that are not all zero; kept at unit length.
Format<Vector3> direction_format();

/// Attitude `[roll, pitch, yaw]` of three angles, rad; see rotation_of.
Format<Vector3> attitude_format();

/// Rotation R_AB of a frame B that is first turned by roll about x, then by pitch about the fixed
/// y, then by yaw about the fixed z of A: R_AB = Rz(yaw) Ry(pitch) Rx(roll). Angles in rad.
Eigen::Matrix3d rotation_of(const Vector3& roll_pitch_yaw);

/// Angles (rad) of which rotation_of makes R_AB, to rounding for every rotation, the pitch from
/// -pi/2 to pi/2. Where it is a right angle roll and yaw turn about one axis: one of the many
/// pairs.
Vector3 roll_pitch_yaw_of(const Eigen::Matrix3d& R_AB);

}  // namespace blocklift::pipeline
