#pragma once

#include <algorithm>
#include <vector>

#include "dynamics/marine/panels/panel_mesh.h"
#include "dynamics/marine/panels/plane_polygon.h"

namespace blocklift::dynamics {

/// How wide panels of the surface may be: `size` within a circle, and further out by `growth` times
/// the way to it.
struct SurfaceFineness {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
  double radius = not_a_number;                      ///< of the circle, m
  double size = not_a_number;                        ///< m
  double growth = 0.1;

  double at(const Eigen::Vector2d& p) const {
    return size + growth * std::max(0.0, (p - centre).norm() - radius);
  }
};

/// Panels of the surface, normals down, with those that are too wide divided evenly in both
/// directions. The pieces need not meet their neighbours at the corners: the potential is constant
/// on a panel. Panels that are images of each other in a plane are divided alike.
/// @param tolerance points nearer to each other than this (m) are one.
std::vector<Panel> refine_surface(const std::vector<Panel>& panels, const SurfaceFineness& fineness,
                                  double tolerance);

}  // namespace blocklift::dynamics
