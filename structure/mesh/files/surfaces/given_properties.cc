#include "structure/mesh/files/surfaces/given_properties.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/files/deck/shell_geometry.h"

namespace blocklift::structure {

namespace {

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
                  const std::optional<Vector3>& towards, int material) {
  const auto section = static_cast<int>(mesh.beam_sections.size());
  mesh.beam_sections.push_back(profile.section);
  mesh.beam_sections.back().material = material;
  for (Group& known : mesh.groups)
    if (known.name == group) known.material = material;
  const ShellsByEdge shells = shells_by_edge(mesh);
  for (Beam& beam : mesh.beams) {
    if (beam.section >= 0 || !is_of_group(mesh, beam.region, group)) continue;
    const Vector3 along =
        (mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]]).normalized();
    const Vector3 wanted = towards.value_or(along.unitOrthogonal());
    const Vector3 across = wanted - along * along.dot(wanted);
    if (across.norm() < 1e-3 * wanted.norm())
      throw ModelError(
          fmt::format("bar {} of group \"{}\" runs along the direction towards which "
                      "its section stands",
                      beam.label, group));
    beam.section = section;
    beam.axis_2 = across.normalized();
    double face = 0;
    const auto [first, last] = shells.equal_range(edge_between(beam.vertices[0], beam.vertices[1]));
    for (auto it = first; towards && it != last; ++it) {
      const Shell& shell = mesh.shells[it->second];
      if (shell.section < 0) continue;
      const double share = std::abs(unit_normal(mesh, shell).dot(beam.axis_2));
      if (share > 1 / std::numbers::sqrt2)
        face = std::max(face, mesh.section_of(shell).thickness / 2);
    }
    const Vector3 axis_3 = along.cross(beam.axis_2);
    const double above_foot = face > 0 ? face - foot_of(profile) : 0;
    const Vector3 offset =
        (above_foot + profile.centroid[0]) * beam.axis_2 + profile.centroid[1] * axis_3;
    beam.offset = {offset, offset};
  }
}

}  // namespace blocklift::structure
