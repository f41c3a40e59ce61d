#include "structure/mesh/files/deck/edge_middles.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Calls visit(from, to, middle) for the edges of all solids, once for each solid that has it.
template <typename Visit>
void for_each_edge_of_solids(const Mesh& mesh, const Visit& visit) {
  for (const Solid& solid : mesh.solids) {
    const SolidTopology& topology = topology_of(solid.shape);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      visit(solid.vertices[topology.edges[e][0]], solid.vertices[topology.edges[e][1]],
            solid.vertices[at(topology.corners) + e]);
  }
}

/// A shell's vertices at the ends of the edge that a place is the middle of.
std::pair<int, int> ends_around(const Shell& shell, const Eigen::Vector2d& middle) {
  const auto& corners = shell.vertices;
  if (middle.y() == 0) return std::minmax(corners[0], corners[1]);
  if (middle.y() == 1) return std::minmax(corners[2], corners[3]);
  return middle.x() == 0 ? std::minmax(corners[0], corners[2])
                         : std::minmax(corners[1], corners[3]);
}

Support held_by_both(const Support& a, const Support& b, int vertex) {
  Support support = a;
  support.vertex = vertex;
  for (std::size_t i = 0; i < 6; ++i) {
    support.held[i] = a.held[i] && b.held[i];
    support.value[i] = support.held[i] ? (a.value[i] + b.value[i]) / 2 : 0;
  }
  return support;
}

}  // namespace

EdgeMiddles own_middles(const Deck& deck) {
  EdgeMiddles middles;
  for (const SurfacePoint& middle : deck.shell_middles)
    middles[ends_around(deck.mesh.shells[middle.shell], middle.xi)] = middle.vertex;
  for_each_edge_of_solids(deck.mesh, [&](int from, int to, int middle) {
    if (middle < deck.own_vertices) middles[std::minmax(from, to)] = middle;
  });
  return middles;
}

Deck with_held_middles(const Deck& deck) {
  Deck held = deck;
  if (deck.own_vertices == 0) return held;  // no reader's: none is known to be made
  for (SupportSet& set : held.support_sets) {
    std::multimap<int, Support> of_vertex;
    for (const Support& support : set.supports) of_vertex.emplace(support.vertex, support);
    std::map<int, std::vector<Support>> of_middle;
    for_each_edge_of_solids(deck.mesh, [&](int from, int to, int middle) {
      if (middle < deck.own_vertices || of_vertex.contains(middle) || of_middle.contains(middle))
        return;
      const auto [first_a, last_a] = of_vertex.equal_range(from);
      const auto [first_b, last_b] = of_vertex.equal_range(to);
      for (auto a = first_a; a != last_a; ++a)
        for (auto b = first_b; b != last_b; ++b) {
          if (!a->second.axes.isApprox(b->second.axes, 1e-9)) continue;
          const Support both = held_by_both(a->second, b->second, middle);
          const bool is_any =
              std::any_of(both.held.begin(), both.held.end(), [](bool h) { return h; });
          if (is_any) of_middle[middle].push_back(both);
        }
    });
    for (const auto& [middle, supports] : of_middle)
      set.supports.insert(set.supports.end(), supports.begin(), supports.end());
  }
  return held;
}

}  // namespace blocklift::structure
