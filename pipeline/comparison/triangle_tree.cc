#include "pipeline/comparison/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace blocklift::pipeline {
namespace {

using Eigen::Vector3d;

constexpr int any_plate = -1;
constexpr std::size_t most_in_a_box = 8;

/// The nearest place of the edge from corner `from` to corner `to`.
void try_edge(const Vector3d& point, const std::array<Vector3d, 3>& corners, std::size_t from,
              std::size_t to, NearestPlace& best) {
  const Vector3d along = corners[to] - corners[from];
  const double square = along.squaredNorm();
  const double share =
      square > 0 ? std::clamp(along.dot(point - corners[from]) / square, 0.0, 1.0) : 0.0;
  const double distance = (corners[from] + share * along - point).norm();
  if (distance >= best.distance) return;
  best.distance = distance;
  best.weights = {};
  best.weights[to] = share;
  best.weights[from] = 1 - share;
}

double distance_to_box(const Vector3d& point, const Vector3d& low, const Vector3d& high) {
  return (low - point).cwiseMax(point - high).cwiseMax(0.0).norm();
}

}  // namespace

NearestPlace nearest_on_triangle(const Vector3d& point, const std::array<Vector3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  NearestPlace best;
  const Vector3d normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  if (square > 1e-24 * longest * longest) {
    const double of_b = (c - a).cross(a - point).dot(normal) / square;
    const double of_c = (a - b).cross(b - point).dot(normal) / square;
    if (of_b >= 0 && of_c >= 0 && of_b + of_c <= 1) {
      best.distance = std::abs(normal.dot(point - a)) / std::sqrt(square);
      best.weights = {1 - of_b - of_c, of_b, of_c};
      return best;
    }
  }
  try_edge(point, corners, 0, 1, best);
  try_edge(point, corners, 1, 2, best);
  try_edge(point, corners, 2, 0, best);
  return best;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (order_.empty()) return;
  boxes_.push_back({Vector3d::Zero(), Vector3d::Zero(), 0, order_.size(), 0});
  for (std::size_t box = 0; box < boxes_.size(); ++box) divide(box);
}

/// Measures a box and, if it holds many triangles, halves it across its longest side.
void TriangleTree::divide(std::size_t box) {
  Box& one = boxes_[box];
  const double infinity = std::numeric_limits<double>::infinity();
  one.low.setConstant(infinity);
  one.high.setConstant(-infinity);
  for (std::size_t i = one.begin; i < one.end; ++i)
    for (const Vector3d& corner : triangles_[order_[i]].corners) {
      one.low = one.low.cwiseMin(corner);
      one.high = one.high.cwiseMax(corner);
    }
  if (one.end - one.begin <= most_in_a_box) return;
  Eigen::Index axis = 0;
  (one.high - one.low).maxCoeff(&axis);
  const auto middle_of = [&](std::size_t number) {
    const auto& corners = triangles_[number].corners;
    return corners[0][axis] + corners[1][axis] + corners[2][axis];
  };
  const std::size_t begin = one.begin, end = one.end, half = begin + (end - begin) / 2;
  const auto place = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(begin), place(half), place(end),
                   [&](std::size_t i, std::size_t j) { return middle_of(i) < middle_of(j); });
  one.children = boxes_.size();
  boxes_.push_back({Vector3d::Zero(), Vector3d::Zero(), begin, half, 0});
  boxes_.push_back({Vector3d::Zero(), Vector3d::Zero(), half, end, 0});
}

NearestPlace TriangleTree::find_nearest(const Vector3d& point) const {
  NearestPlace best;
  if (!boxes_.empty()) search(0, point, any_plate, best);
  return best;
}

NearestPlace TriangleTree::find_nearest(const Vector3d& point, int plate, double farthest) const {
  NearestPlace best;
  best.distance = farthest;
  best.triangle = triangles_.size();
  if (!boxes_.empty()) search(0, point, plate, best);
  return best.triangle < triangles_.size() ? best : NearestPlace{};
}

void TriangleTree::search(std::size_t box, const Vector3d& point, int plate,
                          NearestPlace& best) const {
  const Box& one = boxes_[box];
  if (one.children == 0) {
    for (std::size_t i = one.begin; i < one.end; ++i) {
      const Triangle& triangle = triangles_[order_[i]];
      if (plate != any_plate && triangle.plate != plate) continue;
      NearestPlace found = nearest_on_triangle(point, triangle.corners);
      if (found.distance >= best.distance) continue;
      found.triangle = order_[i];
      best = found;
    }
    return;
  }
  std::array<std::pair<double, std::size_t>, 2> children;
  for (std::size_t i = 0; i < 2; ++i) {
    const Box& child = boxes_[one.children + i];
    children[i] = {distance_to_box(point, child.low, child.high), one.children + i};
  }
  if (children[1] < children[0]) std::swap(children[0], children[1]);
  for (const auto& [distance, child] : children)
    if (distance < best.distance) search(child, point, plate, best);
}

}  // namespace blocklift::pipeline
