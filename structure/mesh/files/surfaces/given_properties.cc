#include "structure/mesh/files/surfaces/given_properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/files/deck/shell_geometry.h"

namespace blocklift::structure {

namespace {

using VertexPair = std::pair<int, int>;

VertexPair pair_of(int a, int b) { return std::minmax(a, b); }

/// Shells by their edges, those halves of curved edges included that end in a point of the shell.
std::multimap<VertexPair, int> shells_by_edge(const Mesh& mesh) {
  std::multimap<VertexPair, int> shells;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const auto& v = mesh.shells[s].vertices;
    for (const auto& [from, to] :
         {pair_of(v[0], v[1]), pair_of(v[1], v[3]), pair_of(v[3], v[2]), pair_of(v[2], v[0])})
      if (from != to) shells.emplace(VertexPair(from, to), static_cast<int>(s));
  }
  for (const SurfacePoint& point : mesh.surface_points)
    for (const int corner : mesh.shells[at(point.shell)].vertices)
      shells.emplace(pair_of(point.vertex, corner), point.shell);
  return shells;
}

bool is_of_group(const Mesh& mesh, int region, const std::string& group) {
  return mesh.group_of_region(region).name == group;
}

}  // namespace

void give_thickness(Mesh& mesh, const std::string& group, double thickness, int material) {
  const auto section = static_cast<int>(mesh.shell_sections.size());
  mesh.shell_sections.push_back({.thickness = thickness, .material = material});
  for (Group& known : mesh.groups)
    if (known.name == group) known.material = material;
  for (Shell& shell : mesh.shells)
    if (shell.section < 0 && is_of_group(mesh, shell.region, group)) shell.section = section;
}

void give_profile(Mesh& mesh, const std::string& group, const Profile& profile,
                  const Vector3& towards, int material) {
  const auto section = static_cast<int>(mesh.beam_sections.size());
  mesh.beam_sections.push_back(profile.section);
  mesh.beam_sections.back().material = material;
  for (Group& known : mesh.groups)
    if (known.name == group) known.material = material;
  const std::multimap<VertexPair, int> shells = shells_by_edge(mesh);
  for (Beam& beam : mesh.beams) {
    if (beam.section >= 0 || !is_of_group(mesh, beam.region, group)) continue;
    const Vector3 along =
        (mesh.vertices[at(beam.vertices[1])] - mesh.vertices[at(beam.vertices[0])]).normalized();
    const Vector3 across = towards - along * along.dot(towards);
    if (across.norm() < 1e-3 * towards.norm())
      throw ModelError(
          fmt::format("bar {} of group \"{}\" runs along the direction towards which "
                      "its section stands",
                      beam.label, group));
    beam.section = section;
    beam.axis_2 = across.normalized();
    double face = 0;
    const auto [first, last] = shells.equal_range(pair_of(beam.vertices[0], beam.vertices[1]));
    for (auto it = first; it != last; ++it) {
      const Shell& shell = mesh.shells[at(it->second)];
      if (shell.section < 0) continue;
      const double share = std::abs(unit_normal(mesh, shell).dot(beam.axis_2));
      if (share > 1 / std::numbers::sqrt2)
        face = std::max(face, mesh.section_of(shell).thickness / 2);
    }
    const Vector3 axis_3 = along.cross(beam.axis_2);
    const Vector3 offset =
        (face + profile.centroid[0]) * beam.axis_2 + profile.centroid[1] * axis_3;
    beam.offset = {offset, offset};
  }
}

}  // namespace blocklift::structure
