#include "structure/mesh/files/surfaces/given_properties.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/beam_lines.h"
#include "structure/mesh/files/deck/shell_geometry.h"

namespace blocklift::structure {

namespace {

bool is_of_group(const Mesh& mesh, int region, const std::string& group) {
  return mesh.group_of_region(region).name == group;
}

/// An end of a beam with the direction of its line there, away from the beam's middle.
struct BeamEnd {
  int beam = 0;
  std::size_t end = 0;
  Vector3 outwards = Vector3::Zero();
};

/// Where bars stand beside the line of their nodes and it turns, the lines of their centroids meet
/// in the plane that halves the angle: a frame within a pipe is as long as its own radius has it,
/// and not as that of the pipe.
/// @param placed beams whose offsets are those of their middles
void join_centroids(Mesh& mesh, const std::vector<int>& placed) {
  constexpr double corner = 0.92;     // cosine of half of 46 degrees, where corners begin
  constexpr double same_line = 1e-3;  // of the offset
  const BeamLines lines(mesh);
  std::map<int, std::vector<BeamEnd>> ends_at;
  for (const int b : placed)
    for (const std::size_t end : {0U, 1U}) {
      const Beam& beam = mesh.beams[b];
      const double outwards = end == 0 ? -1 : 1;
      const Vector3 slope = lines.point_at(beam, static_cast<double>(end)).slope;
      ends_at[beam.vertices[end]].push_back({b, end, outwards * slope.normalized()});
    }
  std::vector<std::pair<BeamEnd, Vector3>> found;
  for (const auto& [vertex, ends] : ends_at) {
    if (ends.size() > 2) continue;
    const Vector3 across =
        ends.size() == 1 ? ends[0].outwards : (ends[0].outwards - ends[1].outwards).normalized();
    if (std::abs(across.dot(ends[0].outwards)) < corner) continue;
    std::vector<Vector3> offsets;
    for (const BeamEnd& end : ends) {
      const Beam& beam = mesh.beams[end.beam];
      const Vector3& offset = beam.offset[end.end];
      const Vector3 way = mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]];
      offsets.push_back(offset - offset.dot(across) / way.dot(across) * way);
    }
    const double apart = (offsets.front() - offsets.back()).norm();
    if (!(apart <= same_line * offsets.front().norm())) continue;  // nor without figures
    for (const BeamEnd& end : ends) found.emplace_back(end, (offsets.front() + offsets.back()) / 2);
  }
  for (const auto& [end, offset] : found) mesh.beams[end.beam].offset[end.end] = offset;
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
  std::vector<int> placed;
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
    placed.push_back(static_cast<int>(&beam - mesh.beams.data()));
  }
  join_centroids(mesh, placed);
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
