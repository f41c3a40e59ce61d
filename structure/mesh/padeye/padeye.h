#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/abaqus_file.h"
#include "structure/mesh/padeye/padeye_geometry.h"

namespace blocklift::structure {

/// Plate of a padeye.
enum class PadeyePlate { main = 0, cheek_front = 1, cheek_back = 2 };

/// Mesh of a padeye in its frame P, m: quadratic hexahedra (20 nodes) swept through the plates.
struct PadeyeMesh {
  /// Sets of elements "main" and "cheeks"; surfaces "hole" and "base" (the cut at y = -height).
  AbaqusMesh mesh;
  /// Elements that lie over one another within one plate, in order of PadeyePlate.
  struct Column {
    PadeyePlate plate = PadeyePlate::main;
    std::array<Eigen::Vector2d, 4> corners;  ///< in P's x and y, counter-clockwise
    std::vector<std::size_t> elements;       ///< tags
  };
  std::vector<Column> columns;
};

/// Meshes a padeye on rays from the middle of the hole.
/// @param divisions elements around the hole, 16 at least; all others are of about their size near
///   the hole and grow towards the base.
/// @throws ModelError with padeye_faults.
PadeyeMesh make_padeye_mesh(const PadeyeGeometry& padeye, int divisions = 32);

}  // namespace blocklift::structure
