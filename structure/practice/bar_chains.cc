#include "structure/practice/bar_chains.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include <Eigen/Geometry>

namespace blocklift::structure {

namespace {

class ChainFinder {
 public:
  ChainFinder(const Mesh& mesh, const MeetingPoints& points, const std::vector<int>& beams,
              double most_turn, const BarGoesOn& goes_on)
      : mesh_(mesh),
        points_(points),
        goes_on_(goes_on),
        least_cosine_(std::cos(most_turn)),
        open_(mesh.beams.size(), false) {
    for (const int beam : beams) open_[beam] = true;
  }

  bool is_open(int beam) const { return open_[beam]; }

  BarChain chain_of(int beam) {
    const Beam& of = mesh_.beams[beam];
    open_[beam] = false;
    BarChain chain{{{beam, false}}, of.vertices[0], of.vertices[1], reach_of(mesh_, of).norm()};
    for (int end = 0; end < 2; ++end) {
      while (extend(chain)) {
      }
      turn(chain);
    }
    return chain;
  }

 private:
  static void turn(BarChain& chain) {
    std::reverse(chain.beams.begin(), chain.beams.end());
    for (auto& [beam, reversed] : chain.beams) reversed = !reversed;
    std::swap(chain.from, chain.to);
  }

  Vector3 direction(int beam, bool reversed) const {
    return (reversed ? -1 : 1) * reach_of(mesh_, mesh_.beams[beam]).normalized();
  }

  bool has_release(int beam, int vertex) const {
    const Beam& of = mesh_.beams[beam];
    const BeamRelease& release = of.release[of.vertices[0] == vertex ? 0 : 1];
    return std::find(release.begin(), release.end(), true) != release.end();
  }

  bool extend(BarChain& chain) {
    const auto [last, last_reversed] = chain.beams.back();
    const auto [first, first_reversed] = chain.beams.front();
    for (const int next : points_.beams(chain.to)) {
      if (!open_[next]) continue;
      const Beam& beam = mesh_.beams[next];
      const bool reversed = beam.vertices[1] == chain.to;
      if (direction(first, first_reversed).dot(direction(next, reversed)) < least_cosine_ ||
          has_release(last, chain.to) || has_release(next, chain.to) ||
          !goes_on_(last, next, chain.to))
        continue;
      open_[next] = false;
      chain.beams.emplace_back(next, reversed);
      chain.to = beam.vertices[reversed ? 0 : 1];
      chain.length += reach_of(mesh_, beam).norm();
      return true;
    }
    return false;
  }

  const Mesh& mesh_;
  const MeetingPoints& points_;
  const BarGoesOn& goes_on_;
  double least_cosine_;
  std::vector<bool> open_;  ///< of each beam: given, and in no chain yet
};

/// The edge of its shell on which a fastened vertex lies; none: it lies within, or is fastened to a
/// line.
std::optional<EdgeKey> edge_under(const Mesh& mesh, const SurfacePoint& point) {
  constexpr double on_edge = 1e-9;  // of the unit square
  if (!point.line.empty()) return std::nullopt;
  for (int edge = 0; edge < 4; ++edge) {
    const auto& ends = round_edges[edge];
    const Eigen::Vector2d from = corner_place(ends[0]), run = corner_place(ends[1]) - from;
    const Eigen::Vector2d off = point.xi - from;
    const EdgeKey key = key_of(mesh, {point.shell, edge});
    if (key.first != key.second && std::abs(run.x() * off.y() - run.y() * off.x()) < on_edge)
      return key;
  }
  return std::nullopt;
}

}  // namespace

std::set<EdgeKey> edges_with_beams(const Mesh& mesh) {
  std::map<int, EdgeKey> edge_of_vertex;
  for (const SurfacePoint& point : mesh.surface_points)
    if (const auto edge = edge_under(mesh, point)) edge_of_vertex[point.vertex] = *edge;
  std::set<EdgeKey> edges;
  std::map<EdgeKey, std::set<int>> reached;  // ends of an edge from a vertex between them
  for (const Beam& beam : mesh.beams) {
    edges.insert(std::minmax(beam.vertices[0], beam.vertices[1]));
    for (std::size_t end = 0; end < 2; ++end) {
      const auto found = edge_of_vertex.find(beam.vertices[end]);
      if (found == edge_of_vertex.end()) continue;
      const EdgeKey& edge = found->second;
      const int other = beam.vertices[1 - end];
      if (other == edge.first || other == edge.second) reached[edge].insert(other);
    }
  }
  for (const auto& [edge, ends] : reached)
    if (ends.size() == 2) edges.insert(edge);
  return edges;
}

MeetingPoints::MeetingPoints(const Mesh& mesh)
    : cells_(mesh.vertices.size()), beams_(mesh.vertices.size()) {
  const auto add_cell = [&](int vertex, int cell) {
    std::vector<int>& cells = cells_[vertex];
    if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  };
  for (std::size_t s = 0; s < mesh.shells.size(); ++s)
    for (const int vertex : mesh.shells[s].vertices) add_cell(vertex, static_cast<int>(s));
  const EdgeMap edges = mesh.surface_points.empty() ? EdgeMap() : collect_edges(mesh);
  for (const SurfacePoint& point : mesh.surface_points) {
    add_cell(point.vertex, point.shell);
    if (const auto edge = edge_under(mesh, point))
      for (const EdgeOfShell& other : edges.at(*edge)) add_cell(point.vertex, other.shell);
  }
  for (std::size_t s = 0; s < mesh.solids.size(); ++s)
    for (const int vertex : mesh.solids[s].vertices)
      add_cell(vertex, static_cast<int>(mesh.shells.size() + s));
  for (std::vector<int>& cells : cells_) std::sort(cells.begin(), cells.end());
  for (std::size_t b = 0; b < mesh.beams.size(); ++b)
    for (const int vertex : mesh.beams[b].vertices) beams_[vertex].push_back(static_cast<int>(b));
  for_each_link(mesh, [&](const std::vector<int>& vertices, long) {
    fastened_.insert(vertices.begin(), vertices.end());
  });
  for (const Spring& spring : mesh.springs)
    fastened_.insert(spring.vertices.begin(), spring.vertices.end());
  for (const LiftingPoint& point : mesh.lifting_points) fastened_.insert(point.vertex);
}

std::vector<int> MeetingPoints::common_cells(int vertex, int other) const {
  std::vector<int> common;
  std::set_intersection(cells(vertex).begin(), cells(vertex).end(), cells(other).begin(),
                        cells(other).end(), std::back_inserter(common));
  return common;
}

std::vector<BarChain> find_bar_chains(const Mesh& mesh, const MeetingPoints& points,
                                      const std::vector<int>& beams, double most_turn,
                                      const BarGoesOn& goes_on) {
  ChainFinder finder(mesh, points, beams, most_turn, goes_on);
  std::vector<BarChain> chains;
  for (const int beam : beams)
    if (finder.is_open(beam)) chains.push_back(finder.chain_of(beam));
  return chains;
}

Vector3 reach_of(const Mesh& mesh, const Beam& beam) {
  return mesh.vertices[beam.vertices[1]] - mesh.vertices[beam.vertices[0]];
}

}  // namespace blocklift::structure
