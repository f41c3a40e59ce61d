#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure::test {

/// The mesh as one of quadratic elements has it: each beam along an edge of shells is two, from the
/// edge's ends to a vertex in its middle, which is fastened to one of the shells.
inline Mesh with_halved_beams(Mesh mesh) {
  const EdgeMap edges = collect_edges(mesh);
  std::vector<Beam> halves;
  for (const Beam& beam : mesh.beams) {
    const int from = beam.vertices[0], to = beam.vertices[1];
    const EdgeOfShell& edge = edges.at(std::minmax(from, to)).front();
    const auto& ends = round_edges[edge.edge];
    const int middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back((mesh.vertices[from] + mesh.vertices[to]) / 2);
    mesh.surface_points.push_back(
        {middle, edge.shell, 0.5 * (corner_place(ends[0]) + corner_place(ends[1]))});
    halves.insert(halves.end(), 2, beam);
    halves[halves.size() - 2].vertices[1] = middle;
    halves.back().vertices[0] = middle;
  }
  mesh.beams = std::move(halves);
  return mesh;
}

}  // namespace blocklift::structure::test
