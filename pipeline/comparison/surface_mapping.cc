#include "pipeline/comparison/surface_mapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "pipeline/comparison/triangle_tree.h"

namespace blocklift::pipeline {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::int32_t, 4>;

/// How far a point is moved into its quadrangle when its plate is sought.
constexpr double step_inside = 0.05;
/// What lengths may differ by rounding, of the surface's size.
constexpr double rounding = 1e-6;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

Vector3d point_of(const BlockSurface& surface, std::int32_t point) {
  return Eigen::Map<const Vector3d>(&surface.points[3 * at(point)]);
}

Corners quad_of(const BlockSurface& surface, std::size_t quad) {
  Corners corners{};
  std::copy_n(surface.quads.begin() + static_cast<std::ptrdiff_t>(4 * quad), 4, corners.begin());
  return corners;
}

/// The group's name, empty where the surface has no groups.
std::string group_of(const BlockSurface& surface, std::size_t quad) {
  return surface.quad_groups.empty() ? std::string()
                                     : surface.groups[at(surface.quad_groups[quad])];
}

double size_of(const BlockSurface& surface) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < surface.point_count(); ++i) {
    const Vector3d point = Eigen::Map<const Vector3d>(&surface.points[3 * i]);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return surface.points.empty() ? 0.0 : (high - low).norm();
}

/// The number of each point's plate: points that quadrangles join are of one.
class Plates {
 public:
  explicit Plates(const BlockSurface& surface) : parent_(surface.point_count()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t quad = 0; quad < surface.quad_count(); ++quad)
      for (const std::int32_t corner : quad_of(surface, quad))
        parent_[at(root(corner))] = root(surface.quads[4 * quad]);
  }
  int of(std::int32_t point) { return root(point); }

 private:
  std::int32_t root(std::int32_t point) {
    while (parent_[at(point)] != point) {
      parent_[at(point)] = parent_[at(parent_[at(point)])];
      point = parent_[at(point)];
    }
    return point;
  }
  std::vector<std::int32_t> parent_;
};

/// The triangles of one group of the reference.
struct Part {
  std::vector<TriangleTree::Triangle> triangles;
  std::vector<std::array<std::int32_t, 3>> points;  ///< of each triangle
  std::optional<TriangleTree> tree;
};

std::map<std::string, Part> parts_of(const BlockSurface& reference) {
  std::map<std::string, Part> parts;
  Plates plates(reference);
  for (std::size_t quad = 0; quad < reference.quad_count(); ++quad) {
    const auto [a, b, c, d] = quad_of(reference, quad);
    Part& part = parts[group_of(reference, quad)];
    for (const std::array<std::int32_t, 3>& corners : {std::array{a, b, c}, std::array{a, c, d}}) {
      const auto& [i, j, k] = corners;
      if (i == j || j == k || k == i) continue;  // of a quadrangle that is a triangle
      part.triangles.push_back(
          {{point_of(reference, i), point_of(reference, j), point_of(reference, k)}, plates.of(i)});
      part.points.push_back(corners);
    }
  }
  for (auto& [name, part] : parts) part.tree.emplace(std::move(part.triangles));
  return parts;
}

double longest_edge(const std::vector<Vector3d>& corners) {
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    longest = std::max(longest, (corners[(i + 1) % corners.size()] - corners[i]).norm());
  return longest;
}

MappedPoint find_counterpart(const Vector3d& point, const std::vector<Vector3d>& quad,
                             const Part& part) {
  const Vector3d centre = (quad[0] + quad[1] + quad[2] + quad[3]) / 4;
  const Vector3d inside = point + step_inside * (centre - point);
  const TriangleTree& tree = *part.tree;
  const NearestPlace plate = tree.find_nearest(inside);
  if (!plate.is_found()) return {};
  // The place that was found is as near as this to the point itself: none farther is sought.
  const double farthest = 1.001 * (plate.distance + (inside - point).norm()) + 1e-9;
  const NearestPlace place =
      tree.find_nearest(point, tree.triangle(plate.triangle).plate, farthest);
  if (!place.is_found()) return {};
  const auto& corners = tree.triangle(place.triangle).corners;
  const double reach = std::max(longest_edge(quad), longest_edge({corners.begin(), corners.end()}));
  if (place.distance > reach) return {};
  return {part.points[place.triangle], place.weights};
}

std::vector<MappedPoint> one_to_one(std::size_t count) {
  std::vector<MappedPoint> mapped(count);
  for (std::size_t i = 0; i < count; ++i) {
    mapped[i].points.fill(static_cast<std::int32_t>(i));
    mapped[i].weights = {1, 0, 0};
  }
  return mapped;
}

}  // namespace

bool have_same_mesh(const BlockSurface& first, const BlockSurface& second) {
  if (first.quads != second.quads || first.quad_groups != second.quad_groups ||
      first.groups != second.groups || first.points.size() != second.points.size())
    return false;
  const double allowed = rounding * size_of(first);
  return std::equal(first.points.begin(), first.points.end(), second.points.begin(),
                    [&](double a, double b) { return std::abs(a - b) <= allowed; });
}

std::vector<MappedPoint> map_surface(const BlockSurface& surface, const BlockSurface& reference) {
  if (have_same_mesh(surface, reference)) return one_to_one(surface.point_count());
  const std::map<std::string, Part> parts = parts_of(reference);
  std::vector<MappedPoint> mapped(surface.point_count());
  std::vector<bool> is_done(surface.point_count(), false);
  for (std::size_t quad = 0; quad < surface.quad_count(); ++quad) {
    const auto part = parts.find(group_of(surface, quad));
    if (part == parts.end()) continue;
    std::vector<Vector3d> corners;
    for (const std::int32_t corner : quad_of(surface, quad))
      corners.push_back(point_of(surface, corner));
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t point = at(surface.quads[4 * quad + i]);
      if (is_done[point]) continue;  // plates share no points: any of its quadrangles will do
      is_done[point] = true;
      mapped[point] = find_counterpart(corners[i], corners, part->second);
    }
  }
  return mapped;
}

double mapped_value(const MappedPoint& place, const std::vector<double>& values,
                    std::size_t components, std::size_t component) {
  if (!place.has_counterpart()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  for (std::size_t i = 0; i < 3; ++i)
    value += place.weights[i] * values[components * at(place.points[i]) + component];
  return value;
}

}  // namespace blocklift::pipeline
