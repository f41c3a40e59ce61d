#include "structure/mesh/files/deck/surface_points.h"

namespace blocklift::structure {

void fasten_used_middles(Deck& deck, const std::vector<SurfacePoint>& middles) {
  deck.shell_middles = middles;
  if (middles.empty()) return;
  Mesh& mesh = deck.mesh;
  std::vector<char> used(mesh.vertices.size(), 0);
  const auto use = [&](int vertex) {
    if (vertex >= 0) used[vertex] = 1;
  };
  for (const Shell& shell : mesh.shells)
    for (const int vertex : shell.vertices) use(vertex);
  for (const Beam& beam : mesh.beams)
    for (const int vertex : beam.vertices) use(vertex);
  for (const PointMass& mass : mesh.masses) use(mass.vertex);
  for_each_link(mesh, [&](const std::vector<int>& vertices, long) {
    for (const int vertex : vertices) use(vertex);
  });
  for (const Spring& spring : mesh.springs)
    for (const int vertex : spring.vertices) use(vertex);
  for (const SupportSet& set : deck.support_sets)
    for (const Support& support : set.supports) use(support.vertex);
  for (const HoldingEquation& held : deck.holding_equations)
    for (const int vertex : vertices_of(held.equation)) use(vertex);
  for (const LoadSet& set : deck.load_sets)
    for (const PointLoad& load : set.point_loads) use(load.vertex);
  for (const SurfacePoint& middle : middles) {
    if (used[middle.vertex] == 0) continue;
    mesh.surface_points.push_back(middle);
    used[middle.vertex] = 0;
  }
}

}  // namespace blocklift::structure
