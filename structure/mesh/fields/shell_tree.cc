#include "structure/mesh/fields/shell_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace blocklift::structure {

namespace {

constexpr int leaf_size = 4;
constexpr int parts_of_curved = 8;  // along each side

Eigen::AlignedBox3d box_of(const Vector3& corner, const Vector3& side_1, const Vector3& side_2) {
  Eigen::AlignedBox3d box(corner);
  box.extend(corner + side_1);
  box.extend(corner + side_2);
  return box;
}

/// Slabs (Kay and Kajiya 1986): is the box met at a distance beyond `from`?
bool meets(const Eigen::AlignedBox3d& box, const Vector3& origin, const Vector3& direction,
           double from) {
  double enter = from, leave = std::numeric_limits<double>::infinity();
  const double margin = 1e-9 * (1 + box.sizes().maxCoeff());
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - margin - origin[axis],
                 high = box.max()[axis] + margin - origin[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double to_low = low / direction[axis], to_high = high / direction[axis];
    enter = std::max(enter, std::min(to_low, to_high));
    leave = std::min(leave, std::max(to_low, to_high));
  }
  return enter <= leave;
}

}  // namespace

ShellTree::ShellTree(const Mesh& mesh, const std::vector<int>& shells) {
  for (const int shell : shells) add(mesh, shell);
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

void ShellTree::add(const Mesh& mesh, int shell) {
  const Shell& of = mesh.shells[shell];
  const int parts = of.curvature < 0 ? 1 : parts_of_curved;
  const auto corner = [&](int i, int j) {
    return position(mesh, of, Eigen::Vector2d(i, j) / parts);
  };
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i) {
      const Vector3 a = corner(i, j), b = corner(i + 1, j), c = corner(i, j + 1),
                    d = corner(i + 1, j + 1);
      triangles_.push_back({shell, a, b - a, c - a});
      triangles_.push_back({shell, d, c - d, b - d});
    }
}

int ShellTree::build(int first, int count) {
  const int number = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centres;
  const auto centre = [](const Triangle& t) -> Vector3 {
    return t.corner + (t.side_1 + t.side_2) / 3;
  };
  for (int i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i];
    box.extend(box_of(t.corner, t.side_1, t.side_2));
    centres.extend(centre(t));
  }
  nodes_[number].box = box;
  if (count <= leaf_size) {
    nodes_[number].first = first;
    nodes_[number].count = count;
    return number;
  }
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto begin = triangles_.begin() + first, middle = begin + count / 2;
  std::nth_element(begin, middle, begin + count, [&](const Triangle& a, const Triangle& b) {
    return centre(a)[axis] < centre(b)[axis];
  });
  build(first, count / 2);
  const int other = build(first + count / 2, count - count / 2);
  nodes_[number].other = other;
  return number;
}

void ShellTree::for_each_near(const Vector3& place, double distance,
                              const std::function<void(int shell)>& visit) const {
  if (nodes_.empty()) return;
  std::vector<int> found, open{0};
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (node.box.squaredExteriorDistance(place) > distance * distance) continue;
    if (node.count == 0) {
      open.push_back(node.other);
      open.push_back(number + 1);
    }
    for (int i = node.first; i < node.first + node.count; ++i) found.push_back(triangles_[i].shell);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const int shell : found) visit(shell);
}

bool ShellTree::is_hit(const Vector3& origin, const Vector3& direction, double from) const {
  if (nodes_.empty()) return false;
  constexpr double slack = 1e-9;  // so that nothing slips through between two triangles
  std::vector<int> open{0};
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    const Node& node = nodes_[number];
    if (!meets(node.box, origin, direction, from)) continue;
    if (node.count == 0) {
      open.push_back(node.other);
      open.push_back(number + 1);
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      // Moeller and Trumbore (1997).
      const Triangle& t = triangles_[i];
      const Vector3 across = direction.cross(t.side_2);
      const double determinant = t.side_1.dot(across);
      if (std::abs(determinant) <= 1e-9 * t.side_1.norm() * t.side_2.norm()) continue;
      const Vector3 arm = origin - t.corner;
      const double u = arm.dot(across) / determinant;
      const Vector3 q = arm.cross(t.side_1);
      const double v = direction.dot(q) / determinant;
      if (u < -slack || v < -slack || u + v > 1 + slack) continue;
      if (t.side_2.dot(q) / determinant > from) return true;
    }
  }
  return false;
}

// The nearest point's region of the plane: Ericson (2005), Real-Time Collision Detection, section
// 5.1.5.
double squared_distance(const Vector3& place, const Vector3& a, const Vector3& side_1,
                        const Vector3& side_2) {
  const Vector3 arm = place - a;
  const double a11 = side_1.squaredNorm(), a12 = side_1.dot(side_2), a22 = side_2.squaredNorm();
  const double b1 = arm.dot(side_1), b2 = arm.dot(side_2);
  const double determinant = a11 * a22 - a12 * a12;
  const double s = a22 * b1 - a12 * b2, t = a11 * b2 - a12 * b1;
  if (s >= 0 && t >= 0 && s + t <= determinant && determinant > 0)
    return (arm - (s * side_1 + t * side_2) / determinant).squaredNorm();
  const auto from_edge = [](const Vector3& from_start, const Vector3& edge) {
    const double length = edge.squaredNorm();
    const double share = length > 0 ? std::clamp(from_start.dot(edge) / length, 0.0, 1.0) : 0;
    return (from_start - share * edge).squaredNorm();
  };
  return std::min(
      {from_edge(arm, side_1), from_edge(arm, side_2), from_edge(arm - side_1, side_2 - side_1)});
}

}  // namespace blocklift::structure
