#pragma once

#include <optional>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// A lug on a mesh that has none of its own: where it is and what carries it.
struct LugOnMesh {
  std::string name;
  std::optional<Vector3> pin = {};  ///< m; absent: the vertex, or the middle of what is named
  int vertex = -1;                  ///< that it stands at; -1: none is named
  /// What carries it, by a named set; all empty: found by place.
  std::vector<int> shells = {}, beams = {}, vertices = {};
  double radius = 0;  ///< within which plates carry it, m; 0: those that meet in the nearest vertex
  double farthest = 1;  ///< from the pin that the nearest vertex may be, m, without a radius
};

/// Adds a lifting point to a mesh.
///
/// Shells that are named, lie with a corner within the radius of the pin or meet in the vertex
/// carry the force, spread over them as over a lug plate. A vertex where no shells meet (of a beam,
/// a link) takes the force as it is, and a set without shells takes it by its vertices, through a
/// distributing link of equal weights whose reference is a new vertex at the pin.
///
/// @throws ModelError if the pin is too far from all plates and no radius is given, no
///   plate lies within the radius, or nothing uses the vertex.
void add_lug(Mesh& mesh, const LugOnMesh& lug);

}  // namespace blocklift::structure
