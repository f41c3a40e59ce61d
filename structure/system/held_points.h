#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/space/space.h"

namespace blocklift::structure {

/// A component of the motion that is held at one of several points.
struct HeldComponent {
  int point = 0;  ///< place among the points
  int axis = 0;   ///< 0 .. 2 of the displacement, 3 .. 5 of the rotation
};

/// 3-2-1 support at points: three far apart, six components that remove the rigid motions and
/// nothing else. The first point is held along x, y, z; of the components at the other two, those
/// three are held that best resist the rigid motions (largest smallest singular value). Of points
/// on one line, such as the nodes of a pipe of beams, the second is held across it and the first
/// against a turn about it.
/// @param points columns, m.
/// @throws ModelError if there are fewer than three.
std::vector<HeldComponent> hold_points(const Eigen::Matrix3Xd& points);

/// Nodes whose displacements follow no others'.
std::vector<int> free_nodes(const Space& space);

}  // namespace blocklift::structure
