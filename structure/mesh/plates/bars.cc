#include "structure/mesh/plates/bars.h"

#include <cmath>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/mesh/files/surfaces/given_properties.h"
#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

namespace {

constexpr double shortest_line = 1e-3;  // m
constexpr double at_end = 1e-3;         // m: beyond the tolerance of joints

void check_bar(const std::string& what, const Bar& bar) {
  const double area = bar.profile.section.area;
  if (!(std::isfinite(area) && area > 0))
    throw ModelError(fmt::format("{} has a section of {:g} m^2; it must be positive", what, area));
  if (!bar.towards && !bar.profile.is_round)
    throw ModelError(what + " has a profile that is not round, and stands towards nothing");
  if (bar.points.size() < 2) throw ModelError(what + " has fewer than two points");
  for (std::size_t i = 0; i + 1 < bar.points.size(); ++i)
    if (!((bar.points[i + 1] - bar.points[i]).norm() > shortest_line))
      throw ModelError(fmt::format("{} has its points {} and {} in one place", what, i + 1, i + 2));
}

/// Frees an end of a beam from bending about both of its axes.
void hinge(BeamRelease& release) { release[4] = release[5] = true; }

void hinge_ends(const Bar& bar, int region, Mesh& mesh) {
  const auto is_at = [&](int vertex, const Vector3& end) {
    return (mesh.vertices[vertex] - end).norm() < at_end;
  };
  for (Beam& beam : mesh.beams) {
    if (beam.region != region) continue;
    if (is_at(beam.vertices[0], bar.points.front())) hinge(beam.release[0]);
    if (is_at(beam.vertices[1], bar.points.back())) hinge(beam.release[1]);
  }
}

}  // namespace

std::vector<BeamLine> add_bars(const BlockDescription& block, Mesh& mesh) {
  std::vector<BeamLine> lines;
  for (const Bar& bar : block.bars) {
    const std::string what = "bar \"" + bar.name + "\"";
    check_bar(what, bar);
    Beam pattern;
    pattern.section = -1;
    pattern.region = static_cast<int>(mesh.regions.size());
    const auto group = static_cast<int>(mesh.groups.size());
    mesh.groups.push_back({bar.name, place_of_material(block, what, bar.material)});
    mesh.regions.push_back({bar.name, group, false});
    for (std::size_t i = 0; i + 1 < bar.points.size(); ++i)
      lines.push_back({bar.points[i], bar.points[i + 1], pattern, bar.name});
  }
  return lines;
}

void finish_bars(const BlockDescription& block, Mesh& mesh) {
  auto region = static_cast<int>(mesh.regions.size() - block.bars.size());
  for (const Bar& bar : block.bars) {
    give_profile(mesh, bar.name, bar.profile, bar.towards, mesh.group_of_region(region).material);
    if (bar.is_hinged) hinge_ends(bar, region, mesh);
    ++region;
  }
}

}  // namespace blocklift::structure
