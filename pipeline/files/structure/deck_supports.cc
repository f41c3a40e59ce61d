#include "pipeline/files/structure/deck_supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/mesh.h"

namespace blocklift::pipeline {

namespace {

using structure::at;
using structure::Deck;
using structure::Mesh;
using structure::Support;
using structure::SupportSet;
using structure::Vector3;

constexpr const char* what_to_do =
    "a lift leaves them out: fasten it to the block by a link, a spring or the part that is "
    "missing";

/// Distance within which two places are one, m.
double nearness(const Mesh& mesh) {
  Vector3 low = mesh.vertices.front(), high = low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return 1e-6 * (high - low).norm();
}

long label_of(const Mesh& mesh, int vertex) {
  return mesh.vertex_labels.empty() ? vertex + 1 : mesh.vertex_labels[at(vertex)];
}

bool holds_anything(const Support& support) {
  return std::any_of(support.held.begin(), support.held.end(), [](bool held) { return held; });
}

/// Does a support resist a displacement along (0 to 2), or a rotation about, an axis of the block?
bool resists(const Support& support, int freedom) {
  const std::size_t first = freedom < 3 ? 0 : 3;
  for (std::size_t i = 0; i < 3; ++i)
    if (support.held[first + i] &&
        std::abs(support.axes(freedom % 3, static_cast<Eigen::Index>(i))) > 0.5)
      return true;
  return false;
}

/// For each vertex: does what a finding says is loose have it?
std::vector<char> vertices_of(const Mesh& mesh, const structure::Finding& finding) {
  std::set<std::array<double, 3>> places;  // copies of the vertices' own
  for (const Vector3& place : finding.places) places.insert({place.x(), place.y(), place.z()});
  std::vector<char> is_loose(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3& vertex = mesh.vertices[v];
    is_loose[v] = places.count({vertex.x(), vertex.y(), vertex.z()}) > 0 ? 1 : 0;
  }
  if (finding.kind != "unconnected parts") return is_loose;
  // A part is loose as a whole.
  const std::vector<int> part = structure::connected_parts(mesh);
  std::set<int> loose;
  for (std::size_t v = 0; v < part.size(); ++v)
    if (is_loose[v] != 0 && part[v] >= 0) loose.insert(part[v]);
  for (std::size_t v = 0; v < part.size(); ++v) is_loose[v] = loose.count(part[v]) > 0 ? 1 : 0;
  return is_loose;
}

}  // namespace

std::vector<std::string> supports_of_what_is_loose(const Deck& deck,
                                                   const structure::Finding& finding) {
  static const std::set<std::string> kinds{"vertices free to move", "vertices free to turn",
                                           "unconnected parts", "masses of nothing"};
  if (deck.support_sets.empty() || kinds.count(finding.kind) == 0) return {};
  const std::vector<char> is_loose = vertices_of(deck.mesh, finding);
  std::set<long> held;
  std::vector<std::string> sets;
  for (const SupportSet& set : deck.support_sets) {
    bool has_any = false;
    for (const Support& support : set.supports) {
      if (is_loose[at(support.vertex)] == 0 || !holds_anything(support)) continue;
      held.insert(label_of(deck.mesh, support.vertex));
      has_any = true;
    }
    if (has_any) sets.push_back(set.name);
  }
  if (held.empty()) return {};
  return {fmt::format("the deck's own supports hold {} there ({}); {}",
                      held.size() == 1
                          ? fmt::format("node {}", *held.begin())
                          : fmt::format("{} nodes, such as {}", held.size(), *held.begin()),
                      fmt::join(sets, ", "), what_to_do)};
}

std::vector<std::string> supports_at_mechanism(const Deck& deck, const Vector3& place,
                                               int freedom) {
  const double near = nearness(deck.mesh);
  double least = std::numeric_limits<double>::infinity();
  const SupportSet* nearest_set = nullptr;
  int nearest = 0;
  for (const SupportSet& set : deck.support_sets)
    for (const Support& support : set.supports) {
      if (!holds_anything(support)) continue;
      const double distance = (deck.mesh.vertices[at(support.vertex)] - place).norm();
      if (distance <= near && resists(support, freedom))
        return {fmt::format("the deck's own supports hold node {} there ({}); {}",
                            label_of(deck.mesh, support.vertex), set.name, what_to_do)};
      if (distance >= least) continue;
      least = distance;
      nearest = support.vertex;
      nearest_set = &set;
    }
  if (nearest_set == nullptr) return {};
  return {fmt::format(
      "the deck's own supports, the nearest at node {} ({}), {:.3g} m away, may be what held that "
      "part; {}",
      label_of(deck.mesh, nearest), nearest_set->name, least, what_to_do)};
}

}  // namespace blocklift::pipeline
