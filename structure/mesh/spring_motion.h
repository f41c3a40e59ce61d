#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// What the motion of its vertex, (displacement in m, rotation in rad), moves the end of a spring
/// along its component, or turns it about it: factors of the six.
inline Eigen::Matrix<double, 6, 1> spring_motion(const Spring& spring, std::size_t end) {
  const Vector3 axis = spring.axes[end].col(spring.components[end] % 3);
  Eigen::Matrix<double, 6, 1> factors;
  if (spring.components[end] >= 3)
    factors << Vector3::Zero(), axis;
  else
    factors << axis, spring.arms[end].cross(axis);
  return factors;
}

}  // namespace blocklift::structure
