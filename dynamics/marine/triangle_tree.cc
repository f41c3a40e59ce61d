#include "dynamics/marine/triangle_tree.h"

#include <algorithm>

namespace blocklift::dynamics {

struct TriangleTree::Item {
  std::array<Vector3, 3> corners;
  Vector3 middle;
};

TriangleTree::TriangleTree(const Hull& hull) {
  std::vector<Item> items;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const int count = static_cast<int>(hull.panel(panel).size()) - 2;
    for (int i = 0; i < count; ++i) {
      const std::array<Vector3, 3> corners = hull.triangle(panel, i);
      items.push_back({corners, (corners[0] + corners[1] + corners[2]) / 3.0});
    }
  }
  build(items);
}

int TriangleTree::build(std::span<Item> items) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  moments_.push_back(SurfaceMoments::zero());
  Vector3 low = items.front().corners[0];
  Vector3 high = low;
  for (const Item& item : items) {
    for (const Vector3& corner : item.corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  Node node;
  SurfaceMoments moments = SurfaceMoments::zero();
  node.centre = 0.5 * (low + high);
  node.half_extent = 0.5 * (high - low);
  if (items.size() <= most_triangles) {
    add_leaf(items, node, moments);
  } else {
    int axis = 0;
    node.half_extent.maxCoeff(&axis);
    const std::size_t half = items.size() / 2;
    std::nth_element(
        items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
        [axis](const Item& a, const Item& b) { return a.middle[axis] < b.middle[axis]; });
    node.left = build(items.subspan(0, half));
    node.right = build(items.subspan(half));
    moments += this->moments(node.left);
    moments += this->moments(node.right);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  moments_[static_cast<std::size_t>(index)] = moments;
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
