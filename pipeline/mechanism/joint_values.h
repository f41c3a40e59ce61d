#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "dynamics/multibody/joint.h"
#include "pipeline/declaration/quantity.h"

namespace blocklift::pipeline {

/// What a file's values for a joint come to: the kernel's numbers, or what is wrong with them.
struct JointVector {
  Eigen::VectorXd values;  ///< coordinates q or velocities v in the kernel's order; see JointKind
  std::string complaint;   ///< completes "the position of joint O"; empty if all is well
};

/// Coordinates of a joint: one quantity for each; of a spherical joint roll, pitch and yaw or a
/// quaternion (w, x, y, z), of a free one a position and then the same.
JointVector joint_position(dynamics::JointKind kind, const std::vector<Quantity>& values);

/// Velocities of a joint: one quantity for each; of a spherical joint angular speeds about the
/// body's axes, of a free one speeds and then angular speeds along them.
JointVector joint_velocity(dynamics::JointKind kind, const std::vector<Quantity>& values);

}  // namespace blocklift::pipeline
