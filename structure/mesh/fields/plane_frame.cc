#include "structure/mesh/fields/plane_frame.h"

#include <Eigen/Geometry>

namespace blocklift::structure {

Eigen::Vector3d normal_of_polygon(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  return area / area.norm();
}

PlaneFrame frame_of_polygon(const std::vector<Eigen::Vector3d>& corners) {
  PlaneFrame frame;
  frame.origin = corners[0];
  const Eigen::Vector3d normal = normal_of_polygon(corners), side = corners[1] - corners[0];
  // Corners may lie off the plane by what is taken as plane.
  frame.axes.col(0) = (side - normal * normal.dot(side)).normalized();
  frame.axes.col(1) = normal.cross(frame.axes.col(0));
  frame.axes.col(2) = normal;
  return frame;
}

}  // namespace blocklift::structure
