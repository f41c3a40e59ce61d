#include "structure/mesh/beam_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blocklift::structure {

namespace {

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
  if (mesh.beams.empty() || mesh.curved_shells.empty()) return;
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
      if (from > to) points = points.rowwise().reverse().eval();
      curved_.try_emplace(std::minmax({from, to}), points);
    }
  }
}

Eigen::Matrix3Xd BeamLines::points_of(const Beam& beam) const {
  const int from = beam.vertices[0], to = beam.vertices[1];
  const auto found = curved_.find(std::minmax({from, to}));
  if (found != curved_.end())
    return from < to ? found->second : Eigen::Matrix3Xd(found->second.rowwise().reverse());
  Eigen::Matrix3Xd ends(3, 2);
  ends << mesh_.vertices[from], mesh_.vertices[to];
  return ends;
}

std::vector<BeamLines::Part> BeamLines::parts(const Beam& beam, const Vector3& arm,
                                              const Vector3& arm_slope) const {
  static const double half = 0.5 / std::sqrt(3.0), wide = 0.5 * std::sqrt(0.6);
  using Rule = std::vector<std::pair<double, double>>;  // shares and weights
  static const Rule of_straight{{0.5 - half, 0.5}, {0.5 + half, 0.5}},
      of_curved{{0.5 - wide, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + wide, 5.0 / 18}};
  const Eigen::Matrix3Xd points = points_of(beam);
  std::vector<Part> parts;
  for (const auto& [share, weight] : points.cols() == 2 ? of_straight : of_curved) {
    const Eigen::Matrix<double, 3, 2> here = points * lagrange_with_slopes(points.cols(), share);
    const Vector3 slope = here.col(1) + arm_slope;
    parts.push_back({share, weight * slope.norm(), here.col(0) + arm + share * arm_slope});
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
