#include "dynamics/marine/panels/coupling_reach.h"

#include <algorithm>
#include <limits>

namespace blocklift::dynamics {
namespace {

constexpr double panels_in_a_wave = 8.0;

/// A point is between two bodies if the way over it is at most so much longer than the gap.
constexpr double detour = 1.2;

double distance_to(const std::vector<WaterLine>& lines, const Vector3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const WaterLine& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vector3& a = line[k];
      const Vector3 ab = line[(k + 1) % line.size()] - a;
      const double s = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - a - s * ab).norm());
    }
  }
  return nearest;
}

}  // namespace

std::vector<CouplingReach> find_coupling_reaches(const PanelModel& model) {
  const PanelMesh surface = expand_symmetry(model.surface_mesh());
  std::vector<std::vector<WaterLine>> lines;
  std::vector<std::vector<double>> distances;
  for (const WettedBody& body : model.bodies()) {
    lines.push_back(find_water_lines(body.hull));
    std::vector<double>& distance = distances.emplace_back();
    for (const Panel& panel : surface.panels) {
      distance.push_back(distance_to(lines.back(), panel.centroid));
    }
  }
  std::vector<CouplingReach> reaches;
  for (std::size_t b = 1; b < lines.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (lines[a].empty() || lines[b].empty()) continue;
      CouplingReach reach{static_cast<int>(a), static_cast<int>(b),
                          std::numeric_limits<double>::infinity(), 0.0};
      for (const WaterLine& line : lines[b]) {
        for (const Vector3& p : line) reach.gap = std::min(reach.gap, distance_to(lines[a], p));
      }
      for (std::size_t k = 0; k < surface.panels.size(); ++k) {
        if (distances[a][k] + distances[b][k] > detour * reach.gap) continue;
        reach.shortest = std::max(reach.shortest, panels_in_a_wave * surface.panels[k].diameter());
      }
      reach.shortest = std::min(reach.shortest, reach.gap);
      reaches.push_back(reach);
    }
  }
  return reaches;
}

std::optional<CouplingReach> find_coupling_reach(const PanelModel& model) {
  std::optional<CouplingReach> worst;
  for (const CouplingReach& reach : find_coupling_reaches(model)) {
    if (!worst || reach.shortest > worst->shortest) worst = reach;
  }
  return worst;
}

}  // namespace blocklift::dynamics
