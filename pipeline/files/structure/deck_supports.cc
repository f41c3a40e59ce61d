#include "pipeline/files/structure/deck_supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/mesh.h"

namespace blocklift::pipeline {

namespace {

using structure::Deck;
using structure::Mesh;
using structure::Support;
using structure::SupportSet;
using structure::Vector3;

long label_of(const Mesh& mesh, int vertex) {
  return mesh.vertex_labels.empty() ? vertex + 1 : mesh.vertex_labels[vertex];
}

bool holds_anything(const Support& support) {
  return std::any_of(support.held.begin(), support.held.end(), [](bool held) { return held; });
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

/// Names nodes and sets of the supports that hold what is loose, if any do.
template <typename Holds>
std::vector<std::string> describe_holding(const Deck& deck, const Holds& holds) {
  std::set<long> held;
  std::vector<std::string> sets;
  for (const SupportSet& set : deck.support_sets) {
    bool has_any = false;
    for (const Support& support : set.supports) {
      if (!holds(support)) continue;
      held.insert(label_of(deck.mesh, support.vertex));
      has_any = true;
    }
    if (has_any) sets.push_back(set.name);
  }
  if (held.empty()) return {};
  return {fmt::format(
      "the deck's own supports hold {} of it ({}); a lift leaves them out: fasten it to the block "
      "by a link, a spring or the part that is missing",
      held.size() == 1 ? fmt::format("node {}", *held.begin())
                       : fmt::format("{} nodes, such as {},", held.size(), *held.begin()),
      fmt::join(sets, ", "))};
}

}  // namespace

std::vector<std::string> supports_of_what_is_loose(const Deck& deck,
                                                   const structure::Finding& finding) {
  static const std::set<std::string> kinds{"vertices free to move", "vertices free to turn",
                                           "unconnected parts", "masses of nothing"};
  if (deck.support_sets.empty() || kinds.count(finding.kind) == 0) return {};
  const std::vector<char> is_loose = vertices_of(deck.mesh, finding);
  return describe_holding(deck, [&](const Support& support) {
    return is_loose[support.vertex] != 0 && holds_anything(support);
  });
}

std::vector<std::string> supports_of_mechanism(
    const Deck& deck, const Eigen::Ref<const Eigen::Matrix<double, 6, -1>>& motion) {
  if (deck.support_sets.empty() || motion.cols() != std::ssize(deck.mesh.vertices)) return {};
  // What most of the block does against itself is rounding.
  const std::array<double, 2> least{0.01 * motion.topRows<3>().colwise().norm().maxCoeff(),
                                    0.01 * motion.bottomRows<3>().colwise().norm().maxCoeff()};
  return describe_holding(deck, [&](const Support& support) {
    for (std::size_t i = 0; i < 6; ++i) {
      const auto part = motion.col(support.vertex).segment<3>(i < 3 ? 0 : 3);
      if (support.held[i] && std::abs(support.axes.col(i % 3).dot(part)) > least[i / 3])
        return true;
    }
    return false;
  });
}

}  // namespace blocklift::pipeline
