#pragma once

#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Unit normal of a plane polygon by its area vector, about which its corners run anticlockwise;
/// not finite if it has no area.
Eigen::Vector3d normal_of_polygon(const std::vector<Eigen::Vector3d>& corners);

/// A plane polygon's own frame: its first corner is the origin, its first side runs along axis u,
/// n is its normal, and v = n x u.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();                  ///< m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();                ///< columns: u, v, n
  Eigen::Vector3d coordinates(const Eigen::Vector3d& point) const {  ///< (u, v, n), m
    return axes.transpose() * (point - origin);
  }
  Eigen::Vector3d point(const Eigen::Vector3d& coordinates) const {
    return origin + axes * coordinates;
  }
};
/// @param corners three at least; the frame is not finite if they have no area.
PlaneFrame frame_of_polygon(const std::vector<Eigen::Vector3d>& corners);

}  // namespace blocklift::structure
