#include "dynamics/marine/hull/hull_edges.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace blocklift::dynamics {

HullEdges find_edges(const Hull& hull) {
  HullEdges edges;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const std::span<const int> corners = hull.panel(panel);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      edges[{std::min(a, b), std::max(a, b)}].push_back({panel, a < b});
    }
  }
  return edges;
}

}  // namespace blocklift::dynamics
