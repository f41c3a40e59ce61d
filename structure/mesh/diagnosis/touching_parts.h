#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Two parts of a mesh that nothing joins and that come close to each other.
struct TouchingParts {
  int vertex = 0;    ///< of one of them
  long cell = 0;     ///< label of the plate or solid of the other that is nearest
  double gap = 0;    ///< between them, the smallest of the pair, m
  int vertices = 0;  ///< of either that lie so close to the other
};

/// Looks for vertices within 5 % of the size of a plate, or of a solid's face, of another part.
/// Thicknesses do not count.
/// @param part of each vertex, -1: none (connected_parts). @returns one a pair of parts.
std::vector<TouchingParts> find_touching_parts(const Mesh& mesh, const std::vector<int>& part);

}  // namespace blocklift::structure
