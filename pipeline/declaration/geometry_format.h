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

}  // namespace blocklift::pipeline
