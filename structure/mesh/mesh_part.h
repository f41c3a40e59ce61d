#pragma once

#include <cstddef>
#include <vector>

namespace blocklift::structure {

/// A part of a mesh: which of its cells and masses are in it, by their places there. What lies
/// beyond the end of a list is not.
struct MeshPart {
  std::vector<char> shells, beams, solids, masses;

  static bool has(const std::vector<char>& list, int place) {
    return place < static_cast<int>(list.size()) && list[static_cast<std::size_t>(place)] != 0;
  }
};

}  // namespace blocklift::structure
