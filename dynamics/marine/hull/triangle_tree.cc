#include "dynamics/marine/hull/triangle_tree.h"

#include <algorithm>
#include <limits>

namespace blocklift::dynamics {

namespace {

struct Bounds {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;

  void add(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  /// In proportion to how often the water's surface crosses the box, upright or heeled by a few
  /// degrees.
  double crossing() const {
    constexpr double heel = 0.05;  // rad
    const Vector3 extent = high - low;
    return extent.z() + heel * (extent.x() + extent.y());
  }
};

}  // namespace

struct TriangleTree::Item {
  std::array<Vector3, 3> corners;
  Vector3 middle;

  Bounds bounds() const {
    Bounds result;
    for (const Vector3& corner : corners) result.add({corner, corner});
    return result;
  }
};

// Sorts the items such that those before the number returned make one box and the others a second,
// both opened as seldom as can be. Neither holds less than a quarter.
std::size_t TriangleTree::split(std::span<Item> items) {
  const std::size_t count = items.size();
  const auto sort_along = [&](Eigen::Index axis) {
    std::stable_sort(items.begin(), items.end(), [axis](const Item& a, const Item& b) {
      return a.middle[axis] < b.middle[axis];
    });
  };
  double least = std::numeric_limits<double>::infinity();
  Eigen::Index best_axis = 0;
  std::size_t best = count / 2;
  std::vector<double> behind(count + 1, 0.0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    sort_along(axis);
    Bounds bounds;
    for (std::size_t i = count; i-- > 0;) {
      bounds.add(items[i].bounds());
      behind[i] = static_cast<double>(count - i) * bounds.crossing();
    }
    bounds = {};
    for (std::size_t i = 0; i < count - count / 4; ++i) {
      const double cost = static_cast<double>(i) * (i > 0 ? bounds.crossing() : 0.0) + behind[i];
      if (i >= std::max<std::size_t>(1, count / 4) && cost < least) {
        least = cost;
        best_axis = axis;
        best = i;
      }
      bounds.add(items[i].bounds());
    }
  }
  sort_along(best_axis);
  return best;
}

TriangleTree::TriangleTree(const Hull& hull, std::size_t leaf_size) {
  std::vector<Item> items;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const int count = static_cast<int>(hull.panel(panel).size()) - 2;
    for (int i = 0; i < count; ++i) {
      const std::array<Vector3, 3> corners = hull.triangle(panel, i);
      items.push_back({corners, (corners[0] + corners[1] + corners[2]) / 3.0});
    }
  }
  build(items, leaf_size);
}

int TriangleTree::build(std::span<Item> items, std::size_t leaf_size) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  moments_.push_back(SurfaceMoments::zero());
  Bounds bounds;
  for (const Item& item : items) bounds.add(item.bounds());
  Node node;
  SurfaceMoments moments = SurfaceMoments::zero();
  node.centre = 0.5 * (bounds.low + bounds.high);
  node.half_extent = 0.5 * (bounds.high - bounds.low);
  if (items.size() <= leaf_size) {
    add_leaf(items, node, moments);
  } else {
    const std::size_t half = split(items);
    node.left = build(items.subspan(0, half), leaf_size);
    node.right = build(items.subspan(half), leaf_size);
    moments += this->moments(node.left);
    moments += this->moments(node.right);
  }
  nodes_[index] = node;
  moments_[index] = moments;
  return index;
}

void TriangleTree::add_leaf(std::span<Item> items, Node& node, SurfaceMoments& moments) {
  node.first_triangle = static_cast<int>(triangles_.size());
  node.triangle_count = static_cast<int>(items.size());
  node.first_point = static_cast<int>(points_.size());
  for (const Item& item : items) {
    const auto& [a, b, c] = item.corners;
    Triangle triangle{{}, 0.5 * (b - a).cross(c - a)};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto first = points_.begin() + node.first_point;
      const auto known = std::find(first, points_.end(), item.corners[i]);
      triangle.corners[i] = static_cast<std::uint8_t>(known - first);
      if (known == points_.end()) points_.push_back(item.corners[i]);
    }
    triangles_.push_back(triangle);
    moments.add_triangle(a, b, c);
  }
  node.point_count = static_cast<int>(points_.size()) - node.first_point;
}

}  // namespace blocklift::dynamics
