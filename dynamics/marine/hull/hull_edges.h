#pragma once

#include <array>
#include <map>
#include <vector>

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// A panel at an edge of a hull.
struct PanelAtEdge {
  int panel = 0;
  bool is_forward = false;  ///< it runs along the edge from the smaller vertex to the larger
};

/// The panels at each edge, in their order; an edge is its two vertices, the smaller first. Of a
/// closed hull each has two, one forward and one not.
using HullEdges = std::map<std::array<int, 2>, std::vector<PanelAtEdge>>;

HullEdges find_edges(const Hull& hull);

}  // namespace blocklift::dynamics
