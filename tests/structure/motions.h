#pragma once

#include <functional>

#include <Eigen/Geometry>

#include "structure/space/space.h"

namespace blocklift::structure::test {

/// Displacement (m) and rotation (rad) at a place, one over the other.
using MotionField = std::function<Eigen::Matrix<double, 6, 1>(const Vector3& place)>;

/// The motion of all nodes, six rows a node.
inline Eigen::VectorXd motion_of(const Space& space, const MotionField& field) {
  Eigen::VectorXd motion(space.freedoms());
  for (Eigen::Index n = 0; n < space.node_count(); ++n)
    motion.segment<6>(6 * n) = field(space.nodes().col(n));
  return motion;
}

/// A mesh moved by a rotation and a translation.
inline Mesh moved(Mesh mesh, const Eigen::Isometry3d& X) {
  for (Vector3& vertex : mesh.vertices) vertex = X * vertex;
  for (Beam& beam : mesh.beams) {
    beam.axis_2 = X.linear() * beam.axis_2;
    for (Vector3& offset : beam.offset) offset = X.linear() * offset;
  }
  for (LiftingPoint& point : mesh.lifting_points) point.p_BPin = X * point.p_BPin;
  return mesh;
}

}  // namespace blocklift::structure::test
