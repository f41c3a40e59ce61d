#include "structure/mesh/beams/beam_axes.h"

#include <Eigen/Geometry>

namespace blocklift::structure {

Eigen::Matrix3d axes_along(const Vector3& line, const Vector3& axis_2) {
  const Vector3 along = line.normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = along;
  axes.row(1) = (axis_2 - along * along.dot(axis_2)).normalized();
  axes.row(2) = along.cross(Vector3(axes.row(1)));
  return axes;
}

Eigen::Matrix3d beam_axes(const Mesh& mesh, const Beam& beam) {
  return axes_along(line_beside(mesh, beam, beam.offset), beam.axis_2);
}

Vector3 line_beside(const Mesh& mesh, const Beam& beam, const std::array<Vector3, 2>& beside) {
  return mesh.vertices[beam.vertices[1]] + beside[1] - mesh.vertices[beam.vertices[0]] - beside[0];
}

}  // namespace blocklift::structure
