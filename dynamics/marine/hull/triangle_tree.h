#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/marine/hull/hull.h"
#include "dynamics/marine/hull/surface_moments.h"

namespace blocklift::dynamics {

/// The triangles of a hull in a tree of boxes, each box with the moments of what it holds, so that
/// only boxes that the water surface crosses are opened. Immutable; may be shared by threads.
class TriangleTree {
 public:
  static constexpr std::size_t most_triangles = 24;               ///< in a leaf, at most
  static constexpr std::size_t most_points = 3 * most_triangles;  ///< in a leaf, at most

  /// A box of the tree.
  struct Node {
    Vector3 centre;       ///< of the box around its triangles, in B, m
    Vector3 half_extent;  ///< m
    int left = -1;        ///< children, behind their parent; -1: a leaf
    int right = -1;
    int first_triangle = 0;
    int triangle_count = 0;  ///< of a leaf
    int first_point = 0;
    int point_count = 0;  ///< of a leaf

    bool is_leaf() const { return left < 0; }
  };
  struct Triangle {
    std::array<std::uint8_t, 3> corners;  ///< counted from the first point of its leaf
    Vector3 area;                         ///< times the unit normal, in B, m2
  };

  /// The hull must have a panel. `leaf_size`: triangles in a leaf, from 1 to `most_triangles`.
  explicit TriangleTree(const Hull& hull, std::size_t leaf_size = most_triangles);

  int triangle_count() const { return static_cast<int>(triangles_.size()); }
  int node_count() const { return static_cast<int>(nodes_.size()); }
  const Node& node(int index) const { return nodes_[index]; }
  const SurfaceMoments& moments(int node) const { return moments_[node]; }
  static constexpr int root = 0;
  std::span<const Triangle> triangles(const Node& leaf) const {
    return {triangles_.data() + leaf.first_triangle, static_cast<std::size_t>(leaf.triangle_count)};
  }
  /// Points of a leaf in B, m.
  std::span<const Vector3> points(const Node& leaf) const {
    return {points_.data() + leaf.first_point, static_cast<std::size_t>(leaf.point_count)};
  }

  /// Calls `leaf(node)` for each leaf below `start` and, before, `open(node, index)` for each box
  /// on the way to it; a box for which `open` returns false stays closed. Does not allocate.
  template <class Open, class Leaf>
  void visit(Open&& open, Leaf&& leaf, int start = root) const {
    std::array<int, most_depth> stack;
    int size = 1;
    stack[0] = start;
    while (size > 0) {
      const int index = stack[--size];
      const Node& node = this->node(index);
      if (!open(node, index)) continue;
      if (node.is_leaf()) {
        leaf(node);
        continue;
      }
      stack[size++] = node.right;
      stack[size++] = node.left;
    }
  }

 private:
  // A box holds three quarters of the triangles of its parent at most: 2^26 would be needed to
  // overflow.
  static constexpr std::size_t most_depth = 64;
  struct Item;
  int build(std::span<Item> items, std::size_t leaf_size);
  static std::size_t split(std::span<Item> items);
  void add_leaf(std::span<Item> items, Node& node, SurfaceMoments& moments);

  std::vector<Node> nodes_;
  std::vector<SurfaceMoments> moments_;
  std::vector<Triangle> triangles_;
  std::vector<Vector3> points_;
};

}  // namespace blocklift::dynamics
