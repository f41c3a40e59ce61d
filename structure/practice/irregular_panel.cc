#include "structure/practice/irregular_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blocklift::structure {

namespace {

using Places = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the area within, positive if the outline runs anticlockwise.
double twice_area(const Places& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sum += cross(outline[i], outline[(i + 1) % outline.size()]);
  return sum;
}

/// Where the corners of a quadrangle are; none if it is none.
std::optional<std::array<std::size_t, 4>> four_corners(const Places& outline, double side) {
  constexpr double limit = std::numbers::pi / 4;
  std::array<std::size_t, 4> corners{};
  std::size_t found = 0;
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d before = outline[i] - outline[(i + count - 1) % count],
                          after = outline[(i + 1) % count] - outline[i];
    const double turn = side * std::atan2(cross(before, after), before.dot(after));
    if (std::abs(turn) < limit) continue;
    if (found == 4 || std::abs(turn - std::numbers::pi / 2) > limit) return std::nullopt;
    corners[found++] = i;
  }
  if (found < 4) return std::nullopt;
  return corners;
}

/// An edge of a quadrangle between two of its corners.
struct CurvedEdge {
  double length = 0;
  Eigen::Vector2d chord = Eigen::Vector2d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< half of the length from either end
};

CurvedEdge edge_from(const Places& outline, std::size_t from, std::size_t to) {
  const std::size_t count = outline.size();
  CurvedEdge edge;
  edge.chord = outline[to] - outline[from];
  for (std::size_t i = from; i != to; i = (i + 1) % count)
    edge.length += (outline[(i + 1) % count] - outline[i]).norm();
  double left = edge.length / 2;
  for (std::size_t i = from; i != to; i = (i + 1) % count) {
    const Eigen::Vector2d step = outline[(i + 1) % count] - outline[i];
    if (left > step.norm()) {
      left -= step.norm();
      continue;
    }
    edge.middle = outline[i] + left * step.normalized();
    break;
  }
  return edge;
}

}  // namespace

std::optional<EquivalentRectangle> equivalent_rectangle(const Places& outline) {
  Places distinct;
  for (const Eigen::Vector2d& place : outline)
    if (distinct.empty() || place != distinct.back()) distinct.push_back(place);
  if (distinct.size() > 1 && distinct.front() == distinct.back()) distinct.pop_back();
  const double area = twice_area(distinct) / 2;
  if (distinct.size() < 4 || area == 0) return std::nullopt;
  const auto corners = four_corners(distinct, area > 0 ? 1 : -1);
  if (!corners) return std::nullopt;
  std::array<CurvedEdge, 4> edges;
  for (std::size_t i = 0; i < 4; ++i)
    edges[i] = edge_from(distinct, (*corners)[i], (*corners)[(i + 1) % 4]);
  const bool is_first = edges[0].length + edges[2].length <= edges[1].length + edges[3].length;
  const CurvedEdge &end = edges[is_first ? 0 : 1], &other = edges[is_first ? 2 : 3];
  EquivalentRectangle rectangle;
  rectangle.length = (other.middle - end.middle).norm();
  if (!(rectangle.length > 0)) return std::nullopt;
  rectangle.along = (other.middle - end.middle) / rectangle.length;
  rectangle.width =
      std::max({std::abs(area) / rectangle.length, std::abs(cross(rectangle.along, end.chord)),
                std::abs(cross(rectangle.along, other.chord))});
  return rectangle;
}

}  // namespace blocklift::structure
