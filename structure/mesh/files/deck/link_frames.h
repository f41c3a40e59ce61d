#pragma once

#include <array>

#include <Eigen/Core>

namespace blocklift::structure {

/// Whether binding these components is the same along any axes: all or none of the displacements,
/// all or none of the rotations.
inline bool is_free_of_axes(const std::array<bool, 6>& bound) {
  return bound[0] == bound[1] && bound[1] == bound[2] && bound[3] == bound[4] &&
         bound[4] == bound[5];
}

inline bool is_identity(const Eigen::Matrix3d& axes) {
  return (axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12;
}

}  // namespace blocklift::structure
