#include "dynamics/marine/radiation/ring_loss.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "dynamics/marine/panels/surface_rings.h"

namespace blocklift::dynamics {
namespace {

// Between 0.025 and 0.3 the figures of a cube in long runs hardly change.
constexpr double strength = 0.1;

/// The panels of the rings within and without a panel's own; -1: none.
struct RingNeighbours {
  int inner = -1, outer = -1;
};

std::vector<RingNeighbours> find_ring_neighbours(const PanelMesh& mesh) {
  std::vector<RingNeighbours> neighbours(mesh.panels.size());
  const auto is_quadrangle = [&](int panel) { return mesh.panels[panel].vertex_count == 4; };
  const auto join = [&](int inner, int outer) {
    neighbours[inner].outer = outer;
    neighbours[outer].inner = inner;
  };
  for (const SharedEdge& edge : find_shared_edges(mesh)) {
    const auto [first, second] = edge.panels;
    if (!is_quadrangle(first) || !is_quadrangle(second)) continue;
    if (edge.sides == std::pair(outer_side, inner_side)) join(first, second);
    if (edge.sides == std::pair(inner_side, outer_side)) join(second, first);
  }
  return neighbours;
}

/// The column of each panel; -1: it is taken together with others.
std::vector<int> find_columns(const SurfaceMesh& surface, const PanelClusters* clusters) {
  std::vector<int> columns(surface.mesh.panels.size());
  std::iota(columns.begin(), columns.end(), 0);
  if (clusters == nullptr) return columns;
  std::vector<int> sizes(static_cast<std::size_t>(clusters->count));
  for (const int cluster : clusters->of_panel) ++sizes[cluster];
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const int cluster = clusters->of_panel[k];
    columns[k] = sizes[cluster] > 1 ? -1 : cluster;
  }
  return columns;
}

}  // namespace

RingDifferences make_ring_differences(const SurfaceMesh& surface, double gravity,
                                      const PanelClusters* clusters) {
  const std::vector<RingNeighbours> neighbours = find_ring_neighbours(surface.mesh);
  const std::vector<int> columns = find_columns(surface, clusters);
  std::vector<Eigen::Triplet<double>> entries;
  int rows = 0;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    if (neighbours[k].inner < 0 || neighbours[k].outer < 0) continue;
    const auto inner = static_cast<std::size_t>(neighbours[k].inner);
    const auto outer = static_cast<std::size_t>(neighbours[k].outer);
    if (std::min({columns[inner], columns[k], columns[outer]}) < 0) continue;
    const auto& panels = surface.mesh.panels;
    const Vector3& middle = panels[k].centroid;
    const double to_inner = (panels[inner].centroid - middle).norm();
    const double to_outer = (panels[outer].centroid - middle).norm();
    const double distance = 0.5 * (to_inner + to_outer);
    const double rate = strength * std::sqrt(gravity / distance);
    const auto add = [&](std::size_t panel, double factor) {
      entries.emplace_back(rows, columns[panel],
                           factor * std::sqrt(rate * panels[k].area / panels[panel].area));
    };
    add(inner, distance / to_inner);
    add(k, -distance / to_inner - distance / to_outer);
    add(outer, distance / to_outer);
    ++rows;
  }
  RingDifferences differences(rows, clusters != nullptr ? clusters->count : surface.mesh.size());
  differences.setFromTriplets(entries.begin(), entries.end());
  return differences;
}

}  // namespace blocklift::dynamics
