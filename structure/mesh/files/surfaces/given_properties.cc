#include "structure/mesh/files/surfaces/given_properties.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

/// Gives beams of a group a profile that stands towards towards_at(middle); none: towards nothing.
using TowardsAt = std::function<Vector3(const Beam& beam, const Vector3& middle)>;
void give_standing_profile(Mesh& mesh, const std::string& group, const Profile& profile,
                           const TowardsAt& towards_at, int material) {
  const auto section = static_cast<int>(mesh.beam_sections.size());
  mesh.beam_sections.push_back(profile.section);
  mesh.beam_sections.back().material = material;
  for (Group& known : mesh.groups)
    if (known.name == group) known.material = material;
  const ShellsByEdge shells = shells_by_edge(mesh);
  for (Beam& beam : mesh.beams) {
    if (beam.section >= 0 || !is_of_group(mesh, beam.region, group)) continue;
    const Vector3 &from = mesh.vertices[beam.vertices[0]], &to = mesh.vertices[beam.vertices[1]];
    const Vector3 along = (to - from).normalized();
    const Vector3 wanted =
        towards_at ? towards_at(beam, (from + to) / 2) : Vector3(along.unitOrthogonal());
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
    for (auto it = first; towards_at && it != last; ++it) {
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
  TowardsAt towards_at;
  if (towards) towards_at = [&](const Beam&, const Vector3&) { return *towards; };
  give_standing_profile(mesh, group, profile, towards_at, material);
}

void give_profile(Mesh& mesh, const std::string& group, const Profile& profile,
                  const FrameAxis& axis, int material) {
  const auto towards_axis = [&](const Beam& beam, const Vector3& middle) -> Vector3 {
    const Vector3 from_point = middle - axis.point;
    const Vector3 outwards = from_point - axis.along * axis.along.dot(from_point);
    if (outwards.norm() < 1e-6 * (1 + from_point.norm()))
      throw ModelError(
          fmt::format("bar {} of group \"{}\" lies on the axis around which its group runs",
                      beam.label, group));
    return (axis.is_outside ? 1.0 : -1.0) * outwards.normalized();
  };
  give_standing_profile(mesh, group, profile, towards_axis, material);
}

}  // namespace blocklift::structure
