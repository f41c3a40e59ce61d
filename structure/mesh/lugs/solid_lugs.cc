#include "structure/mesh/lugs/solid_lugs.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace blocklift::structure {

namespace {

/// The ends of a line by vertices on it.
SolidLugBase line_through(const Mesh& mesh, int region, const std::vector<int>& on_it) {
  const auto farthest_from = [&](int vertex) {
    const auto distance = [&](int other) {
      return (mesh.vertices[other] - mesh.vertices[vertex]).squaredNorm();
    };
    return *std::max_element(on_it.begin(), on_it.end(),
                             [&](int a, int b) { return distance(a) < distance(b); });
  };
  const int from = farthest_from(on_it.front()), to = farthest_from(from);
  return {region, mesh.vertices[from], mesh.vertices[to], {from, to}};
}

}  // namespace

std::vector<SolidLugBase> find_solid_lug_bases(const Mesh& mesh) {
  std::vector<SolidLugBase> bases;
  if (mesh.solids.empty() || mesh.surface_points.empty()) return bases;
  std::unordered_map<int, int> region_of;  // of the vertices of lugs' solids
  for (const Solid& solid : mesh.solids)
    if (mesh.regions[solid.region].is_lug)
      for (const int vertex : solid.vertices) region_of.emplace(vertex, solid.region);
  std::map<int, std::vector<int>> feet;  // by region
  for (const RigidLink& link : mesh.rigid_links) {
    const auto found = link.slaves.empty() ? region_of.end() : region_of.find(link.slaves.front());
    if (found != region_of.end()) feet[found->second].push_back(link.master);
  }
  for (const auto& [region, on_line] : feet) bases.push_back(line_through(mesh, region, on_line));
  return bases;
}

std::vector<char> groups_of_solid_lugs(const Mesh& mesh) {
  std::vector<char> is_one(mesh.groups.size(), 0);
  for (const Solid& solid : mesh.solids)
    if (mesh.regions[solid.region].is_lug) is_one[mesh.regions[solid.region].group] = 1;
  return is_one;
}

}  // namespace blocklift::structure
