#pragma once

#include <string>
#include <vector>

#include "structure/elasticity/part_model.h"

namespace blocklift::structure {

/// What supports leave of the rigid motions of a mesh.
struct RigidFreedom {
  int count = 0;   ///< independent motions
  int bodies = 0;  ///< parts of the mesh that have no node in common and no tie
  /// In words: "translation along x", "rotation about the axis along (0, 0, 1) through (1, 2, 0)
  /// m"; of which body where there are several that share no node, of which elements where they
  /// hang on the others by an edge or a point.
  std::vector<std::string> motions;
};

/// Elements that share a face move as one; where such pieces share an edge or a point only, they
/// are hinged there, which no stiffness resists.
RigidFreedom find_rigid_freedom(const PartModel& model, const std::vector<FixedUnknown>& fixed);

}  // namespace blocklift::structure
