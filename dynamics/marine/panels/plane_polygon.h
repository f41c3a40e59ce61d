#pragma once

#include <vector>

#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// Closed polygon in the plane of the calm water, m.
using PlanePolygon = std::vector<Eigen::Vector2d>;

/// z component of the vector product.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

PlanePolygon to_polygon(const WaterLine& line);
/// Centre of the enclosed area.
Eigen::Vector2d centroid(const PlanePolygon& polygon);
/// Is the point within the polygon, however that runs?
bool contains(const PlanePolygon& polygon, const Eigen::Vector2d& p);

}  // namespace blocklift::dynamics
