#include "structure/mesh/solid_lugs.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace blocklift::structure {

namespace {

/// The ends of a line by points on it.
SolidLugBase line_through(int region, const std::vector<Vector3>& points) {
  const auto farthest_from = [&](const Vector3& place) {
    return *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return (a - place).squaredNorm() < (b - place).squaredNorm();
    });
  };
  const Vector3 from = farthest_from(points.front());
  return {region, from, farthest_from(from)};
}

}  // namespace

std::vector<SolidLugBase> find_solid_lug_bases(const Mesh& mesh) {
  std::vector<SolidLugBase> bases;
  if (mesh.solids.empty() || mesh.surface_points.empty()) return bases;
  std::unordered_map<int, int> region_of;  // of the vertices of lugs' solids
  for (const Solid& solid : mesh.solids)
    if (mesh.regions[solid.region].is_lug)
      for (const int vertex : solid.vertices) region_of.emplace(vertex, solid.region);
  std::map<int, std::vector<Vector3>> places;  // by region
  for (const RigidLink& link : mesh.rigid_links) {
    const auto found = link.slaves.empty() ? region_of.end() : region_of.find(link.slaves.front());
    if (found != region_of.end()) places[found->second].push_back(mesh.vertices[link.master]);
  }
  for (const auto& [region, points] : places) bases.push_back(line_through(region, points));
  return bases;
}

std::vector<char> groups_of_solid_lugs(const Mesh& mesh) {
  std::vector<char> is_one(mesh.groups.size(), 0);
  for (const Solid& solid : mesh.solids)
    if (mesh.regions[solid.region].is_lug) is_one[mesh.regions[solid.region].group] = 1;
  return is_one;
}

}  // namespace blocklift::structure
