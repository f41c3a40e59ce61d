#include "structure/mesh/files/deck/parted_edges.h"

#include <algorithm>

#include <Eigen/Core>
#include <fmt/format.h>

namespace blocklift::structure {

void PartedEdges::take(const GivenMiddle& middle) {
  constexpr int most_named = 10;
  const auto place = [&](int vertex) -> const Vector3& { return mesh_.vertices[vertex]; };
  const std::pair<int, int> ends = std::minmax({middle.from, middle.to});
  const double length = (place(middle.to) - place(middle.from)).norm();
  const auto [first, last] = known_.equal_range(ends);
  for (auto known = first; known != last; ++known) {
    const Known& other = known->second;
    if (other.vertex == middle.vertex) return;
    if ((place(other.vertex) - place(middle.vertex)).norm() > apart_ * length) continue;
    if (++count_ > most_named) {
      log_.complain(middle.line,
                    fmt::format("{}: one more edge has two nodes in its middle", middle.card));
      return;
    }
    log_.complain(
        middle.line,
        fmt::format("{}: element {} has node {} in the middle of the edge from node {} to {}, and "
                    "element {} ({}) has node {} there, so that they would part along the edge; "
                    "it is so where parts become quadratic one by one: merge nodes that lie at "
                    "one place, middles too",
                    middle.card, middle.element, label(middle.vertex), label(ends.first),
                    label(ends.second), other.element, log_.place(other.line),
                    label(other.vertex)));
    return;
  }
  known_.emplace(ends, Known{middle.vertex, middle.element, middle.line});
}

long PartedEdges::label(int vertex) const {
  return mesh_.vertex_labels.empty() ? long{vertex} + 1 : mesh_.vertex_labels[vertex];
}

}  // namespace blocklift::structure
