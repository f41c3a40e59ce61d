#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// How large the elements of a geometry shall be, m.
struct SurfaceSizes {
  double largest = 0;           ///< longest edge
  double at_places = 0;         ///< about each of the places, growing from there on
  std::vector<Vector3> places;  ///< such as the pins of lugs
};

/// Meshes all surfaces and curves of Gmsh's current model, with quadrangles where triangles can be
/// joined in pairs.
///
/// Circles have 24 elements a turn at least, other curves down to an eighth of the largest size,
/// from which sizes grow into the surfaces. Elements are of second order where anything is
/// curved.
/// @param length of the unit of the model's coordinates, m.
/// @throws ModelError if there would be more than two million elements (before they are made), or
///   a surface cannot be meshed.
void mesh_surfaces(const SurfaceSizes& sizes, double length);

}  // namespace blocklift::structure
