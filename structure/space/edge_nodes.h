#pragma once

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/joints.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// Calls visit(node, from, to, share) for each node within an edge of a shell or solid, between the
/// edge's vertices, once for each element that has it; share is 0 at `from` and 1 at `to`.
template <typename Visit>
void for_each_node_within_edges(const Space& space, const Visit& visit) {
  const auto visit_within = [&](int node, int from, int to, double share) {
    if (from != to && share > 0 && share < 1) visit(node, from, to, share);
  };
  const std::vector<double> places = lagrange_places(space.degree());
  for (int cell = 0; cell < static_cast<int>(space.shells().size()); ++cell) {
    const ShellCell& located = space.shells()[cell];
    const auto& corners = space.mesh().shells[located.shell].vertices;
    const int* node = space.shell_nodes(cell);
    for (const double y : places)
      for (const double x : places) {
        const Eigen::Vector2d xi = located.origin + located.size * Eigen::Vector2d(x, y);
        if (xi.y() == 0) visit_within(*node, corners[0], corners[1], xi.x());
        if (xi.y() == 1) visit_within(*node, corners[2], corners[3], xi.x());
        if (xi.x() == 0) visit_within(*node, corners[0], corners[2], xi.y());
        if (xi.x() == 1) visit_within(*node, corners[1], corners[3], xi.y());
        ++node;
      }
  }
  for (std::size_t number = 0; number < space.mesh().solids.size(); ++number) {
    const Solid& solid = space.mesh().solids[number];
    const SolidTopology& topology = topology_of(solid.shape);
    const int* nodes = space.solid_nodes(static_cast<int>(number));
    for (std::size_t edge = 0; edge < topology.edges.size(); ++edge)
      visit_within(nodes[at(topology.corners) + edge], solid.vertices[topology.edges[edge][0]],
                   solid.vertices[topology.edges[edge][1]], 0.5);
  }
}

}  // namespace blocklift::structure
