#include "dynamics/marine/green/water_plane_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace blocklift::dynamics {
namespace {

/// From and to, m.
using Interval = std::array<double, 2>;

/// Where a line along x is within a body: between its crossings with the water lines, two by two.
std::vector<Interval> find_inside(const std::vector<WaterLine>& lines, double y) {
  std::vector<double> crossings;
  for (const WaterLine& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vector3 &a = line[k], &b = line[(k + 1) % line.size()];
      if ((a.y() > y) == (b.y() > y)) continue;
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<Interval> inside;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    inside.push_back({crossings[k], crossings[k + 1]});
  }
  return inside;
}

/// What of an interval none of the others covers.
std::vector<Interval> subtract(const Interval& whole, std::vector<Interval> others) {
  std::sort(others.begin(), others.end());
  std::vector<Interval> left;
  double from = whole[0];
  for (const Interval& other : others) {
    if (other[0] > from) left.push_back({from, std::min(other[0], whole[1])});
    from = std::max(from, other[1]);
    if (from >= whole[1]) return left;
  }
  left.push_back({from, whole[1]});
  return left;
}

/// The strips' edges: those of bodies and regions, and what divides them evenly between.
std::vector<double> find_edges(const std::vector<WaterLine>& lines,
                               const std::vector<WaterPlaneRegion>& regions, bool mirrored,
                               double size) {
  std::vector<double> bounds;
  for (const WaterLine& line : lines) {
    const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [](const Vector3& a, const Vector3& b) { return a.y() < b.y(); });
    bounds.insert(bounds.end(), {low->y(), high->y()});
  }
  for (const WaterPlaneRegion& region : regions) {
    bounds.insert(bounds.end(), {region.low.y(), region.high.y()});
  }
  if (mirrored) {
    for (double& bound : bounds) bound = std::max(bound, 0.0);
  }
  std::sort(bounds.begin(), bounds.end());
  std::vector<double> edges;
  for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
    const double gap = bounds[k + 1] - bounds[k];
    if (gap < 1e-6 * size) continue;
    const int count = static_cast<int>(std::ceil(gap / size - 1e-9));
    for (int i = 0; i < count; ++i) edges.push_back(bounds[k] + gap * i / count);
  }
  if (!bounds.empty()) edges.push_back(bounds.back());
  return edges;
}

/// Adds the cells of a strip's interval.
void add_cells(Interval along, const Interval& across, const Symmetry& symmetry, double size,
               int region, WaterPlaneCells& cells) {
  if (symmetry.x) along[0] = std::max(along[0], 0.0);
  const double length = along[1] - along[0];
  if (length < 1e-3 * size) return;
  const int count = static_cast<int>(std::ceil(length / size - 1e-9));
  for (int i = 0; i < count; ++i) {
    const double from = along[0] + length * i / count, to = along[0] + length * (i + 1) / count;
    cells.panels.push_back(
        make_panel(std::array{Vector3(from, across[0], 0.0), Vector3(from, across[1], 0.0),
                              Vector3(to, across[1], 0.0), Vector3(to, across[0], 0.0)}));
    cells.region.push_back(region);
  }
}

}  // namespace

WaterPlaneCells make_water_plane_cells(const std::vector<WaterLine>& water_lines,
                                       const std::vector<WaterPlaneRegion>& regions,
                                       const Symmetry& symmetry, double size) {
  WaterPlaneCells cells;
  const std::vector<double> edges = find_edges(water_lines, regions, symmetry.y, size);
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const Interval across{edges[k], edges[k + 1]};
    const double middle = 0.5 * (across[0] + across[1]);
    std::vector<Interval> taken = find_inside(water_lines, middle);
    for (const Interval& inside : taken) add_cells(inside, across, symmetry, size, -1, cells);
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const WaterPlaneRegion& region = regions[r];
      if (middle < region.low.y() || middle > region.high.y()) continue;
      const Interval whole{region.low.x(), region.high.x()};
      for (const Interval& open : subtract(whole, taken)) {
        add_cells(open, across, symmetry, size, static_cast<int>(r), cells);
      }
      taken.push_back(whole);
    }
  }
  return cells;
}

}  // namespace blocklift::dynamics
