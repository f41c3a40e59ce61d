#pragma once

#include <span>

#include "structure/space/space.h"

namespace blocklift::structure::test {

/// Rigid motions of an element's nodes, in the order of its freedoms.
/// @param nodes  of the space.
/// @return 6 rows a node and 6 columns: unit displacements, then unit rotations about the origin.
inline Eigen::MatrixXd rigid_motions(const Space& space, std::span<const int> nodes) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), 6);
  Eigen::Index row = 0;
  for (const int node : nodes) {
    const Vector3 x = space.nodes().col(node);
    for (int c = 0; c < 3; ++c) {
      rigid(row + c, c) = rigid(row + 3 + c, 3 + c) = 1;
      rigid.block<3, 1>(row, 3 + c) = Vector3::Unit(c).cross(x);
    }
    row += 6;
  }
  return rigid;
}

}  // namespace blocklift::structure::test
