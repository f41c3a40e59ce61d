#include "structure/mesh/beam_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

constexpr double straight_edge = 1e-9;  // of an edge's length

/// Values of Lagrange's polynomials over equally spaced points, and their slopes, at a share of the
/// way.
Eigen::MatrixX2d lagrange_with_slopes(Eigen::Index count, double share) {
  Eigen::MatrixX2d values(count, 2);
  const auto intervals = static_cast<double>(count - 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    double value = 1, slope = 0;
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j == i) continue;
      const auto apart = static_cast<double>(i - j);
      const double factor = (share * intervals - static_cast<double>(j)) / apart;
      slope = slope * factor + value * intervals / apart;
      value *= factor;
    }
    values.row(i) << value, slope;
  }
  return values;
}

}  // namespace

BeamLines::BeamLines(const Mesh& mesh) : mesh_(mesh) {
  if (mesh.beams.empty()) return;
  struct Edge {
    std::size_t from, to;
    Eigen::Vector2d begin, end;  ///< on the shell's unit square
  };
  static const std::array<Edge, 4> edges{{{0, 2, {0, 0}, {0, 1}},
                                          {1, 3, {1, 0}, {1, 1}},
                                          {0, 1, {0, 0}, {1, 0}},
                                          {2, 3, {0, 1}, {1, 1}}}};
  for (const Shell& shell : mesh.shells) {
    if (shell.curvature < 0) continue;
    const auto count = static_cast<Eigen::Index>(
        std::lround(std::sqrt(static_cast<double>(mesh.curved_shells[shell.curvature].cols()))));
    for (const Edge& edge : edges) {
      const int from = shell.vertices[edge.from], to = shell.vertices[edge.to];
      if (from == to) continue;  // of a triangle
      Eigen::Matrix3Xd points(3, count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        points.col(i) = position(mesh, shell, (1 - share) * edge.begin + share * edge.end);
      }
      add_edge(from, to, std::move(points));
    }
  }
  for (const Solid& solid : mesh.solids) {
    const SolidTopology& topology = topology_of(solid.shape);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const int from = solid.vertices[topology.edges[e][0]],
                to = solid.vertices[topology.edges[e][1]];
      Eigen::Matrix3Xd points(3, 3);
      points << mesh.vertices[from], mesh.vertices[solid.vertices[at(topology.corners) + e]],
          mesh.vertices[to];
      add_edge(from, to, std::move(points));
    }
  }
}

void BeamLines::add_edge(int from, int to, Eigen::Matrix3Xd points) {
  const Eigen::Index last = points.cols() - 1;
  const Vector3 begin = points.col(0), way = points.col(last) - begin;
  bool is_curved = false;
  for (Eigen::Index i = 1; i < last; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(last);
    is_curved =
        is_curved || (points.col(i) - begin - share * way).norm() > straight_edge * way.norm();
  }
  if (!is_curved) return;
  if (from > to) points = points.rowwise().reverse().eval();
  curved_.try_emplace(std::minmax(from, to), std::move(points));
}

bool BeamLines::is_curved(const Beam& beam) const {
  return !curved_.empty() && curved_.contains(std::minmax(beam.vertices[0], beam.vertices[1]));
}

BeamLines::Point BeamLines::point_at(const Beam& beam, double share) const {
  const int from = beam.vertices[0], to = beam.vertices[1];
  const auto found = curved_.find(std::minmax(from, to));
  if (found == curved_.end()) {
    const Vector3 &a = mesh_.vertices[from], way = mesh_.vertices[to] - a;
    return {a + share * way, way};
  }
  const bool is_reversed = from > to;
  const Eigen::Matrix<double, 3, 2> here =
      found->second * lagrange_with_slopes(found->second.cols(), is_reversed ? 1 - share : share);
  return {here.col(0), is_reversed ? Vector3(-here.col(1)) : Vector3(here.col(1))};
}

std::vector<BeamLines::Part> BeamLines::parts(const Beam& beam, const Vector3& arm,
                                              const Vector3& arm_slope) const {
  static const double half = 0.5 / std::sqrt(3.0), wide = 0.5 * std::sqrt(0.6);
  using Rule = std::vector<std::pair<double, double>>;  // shares and weights
  static const Rule of_straight{{0.5 - half, 0.5}, {0.5 + half, 0.5}},
      of_curved{{0.5 - wide, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + wide, 5.0 / 18}};
  std::vector<Part> parts;
  for (const auto& [share, weight] : is_curved(beam) ? of_curved : of_straight) {
    const Point here = point_at(beam, share);
    parts.push_back(
        {share, weight * (here.slope + arm_slope).norm(), here.place + arm + share * arm_slope});
  }
  return parts;
}

double BeamLines::length(const Beam& beam) const {
  double sum = 0;
  for (const Part& part : parts(beam, Vector3::Zero(), Vector3::Zero())) sum += part.length;
  return sum;
}

std::vector<BeamLines::Part> BeamLines::centroid_parts(const Beam& beam) const {
  return parts(beam, beam.offset[0], beam.offset[1] - beam.offset[0]);
}

}  // namespace blocklift::structure
