#pragma once

#include <map>
#include <utility>
#include <vector>

namespace blocklift::structure {

/// Entity of Gmsh's model: dimension and tag.
using Entity = std::pair<int, int>;

/// Cuts surfaces and curves of Gmsh's current OpenCASCADE model at their joints, so that pieces
/// that meet share edges and corners, and meshes share nodes; curves within a surface are embedded
/// in it.
/// @param owner of each entity, any number.
/// @param tolerance within which things meet, in the model's unit.
/// @returns the owners of each piece, ascending; several where entities lie upon one another.
/// @throws ModelError if OpenCASCADE cannot do it.
std::map<Entity, std::vector<int>> cut_at_joints(const std::map<Entity, int>& owners,
                                                 double tolerance);

}  // namespace blocklift::structure
