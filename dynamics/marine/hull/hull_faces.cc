#include "dynamics/marine/hull/hull_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace blocklift::dynamics {
namespace {

constexpr double flat = 1e-9;  // share of the size

/// A convex polygon.
struct Face {
  std::vector<int> corners;  ///< vertices of the hull
  Vector3 normal;            ///< of unit length
};

Vector3 area_vector(const Hull& hull, const std::vector<int>& corners) {
  Vector3 doubled = Vector3::Zero();
  const Vector3& origin = hull.vertex(corners[0]);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    doubled += (hull.vertex(corners[k]) - origin).cross(hull.vertex(corners[k + 1]) - origin);
  }
  return 0.5 * doubled;
}

/// Sine of the turn at corner k, seen from the side of the normal; along the edges: 0.
double turn_at(const Hull& hull, const Face& face, std::size_t k) {
  const std::size_t count = face.corners.size();
  const Vector3& at = hull.vertex(face.corners[k]);
  const Vector3 in = at - hull.vertex(face.corners[(k + count - 1) % count]);
  const Vector3 out = hull.vertex(face.corners[(k + 1) % count]) - at;
  return face.normal.dot(in.cross(out)) / (in.norm() * out.norm());
}

bool lies_in_plane(const Hull& hull, const Face& face, const std::vector<int>& others) {
  const Vector3& origin = hull.vertex(face.corners[0]);
  return std::all_of(others.begin(), others.end(), [&](int vertex) {
    const Vector3 arm = hull.vertex(vertex) - origin;
    return std::abs(face.normal.dot(arm)) <= flat * arm.norm();
  });
}

/// Both faces as one, b having the edge that follows a's corner `from` the other way round; none if
/// they do not lie in one plane or are not convex together.
std::optional<Face> joined(const Hull& hull, const Face& a, const Face& b, std::size_t from) {
  if (a.normal.dot(b.normal) <= 0.0 || !lies_in_plane(hull, a, b.corners) ||
      !lies_in_plane(hull, b, a.corners)) {
    return {};
  }
  const std::size_t n = a.corners.size(), m = b.corners.size();
  const int first = a.corners[from];
  const auto found = std::find(b.corners.begin(), b.corners.end(), first);
  const auto start = static_cast<std::size_t>(found - b.corners.begin());
  Face both{{}, a.normal};
  // a from the edge's end round to its start, then b without the edge.
  for (std::size_t k = 1; k <= n; ++k) both.corners.push_back(a.corners[(from + k) % n]);
  for (std::size_t k = 1; k + 1 < m; ++k) both.corners.push_back(b.corners[(start + k) % m]);
  // Corners where they meet: bent inwards, straight, or a corner still.
  for (const std::size_t k : {n - 1, std::size_t{0}}) {
    const double turn = turn_at(hull, both, k);
    if (turn < -flat) return {};
    if (turn <= flat) both.corners.erase(both.corners.begin() + static_cast<std::ptrdiff_t>(k));
  }
  if (both.corners.size() < 3) return {};
  return both;
}

using Edge = std::pair<int, int>;

Edge edge_of(const Face& face, std::size_t k) {
  return {face.corners[k], face.corners[(k + 1) % face.corners.size()]};
}

/// Joins each face with one neighbour at most. False: there was nothing to join.
bool join_pairs(const Hull& hull, std::vector<Face>& faces) {
  std::map<Edge, std::size_t> owner;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t k = 0; k < faces[i].corners.size(); ++k) owner[edge_of(faces[i], k)] = i;
  }
  std::vector<char> used(faces.size(), 0);
  std::vector<Face> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (used[i] != 0) continue;
    used[i] = 1;
    std::optional<Face> both;
    for (std::size_t k = 0; k < faces[i].corners.size() && !both; ++k) {
      const auto [from, to] = edge_of(faces[i], k);
      const auto other = owner.find({to, from});
      if (other == owner.end() || used[other->second] != 0) continue;
      both = joined(hull, faces[i], faces[other->second], k);
      if (both) used[other->second] = 1;
    }
    result.push_back(both ? std::move(*both) : std::move(faces[i]));
  }
  const bool any = result.size() < faces.size();
  faces = std::move(result);
  return any;
}

}  // namespace

Hull join_flat_panels(const Hull& hull) {
  std::vector<Face> faces;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const auto corners = hull.panel(panel);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      Face face{{corners[0], corners[k], corners[k + 1]}, Vector3::Zero()};
      const Vector3 area = area_vector(hull, face.corners);
      if (area.norm() > 0.0) face.normal = area.normalized();
      faces.push_back(std::move(face));
    }
  }
  while (join_pairs(hull, faces)) {
  }
  Hull result(hull.name());
  for (const Vector3& vertex : hull.vertices()) result.add_vertex(vertex);
  for (const Face& face : faces) result.add_panel(face.corners);
  return result;
}

namespace {

using Polygon = std::vector<Vector3>;

/// What of a convex polygon lies where direction . p <= limit.
Polygon clipped(const Polygon& polygon, const Vector3& direction, double limit) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3& from = polygon[k];
    const Vector3& to = polygon[(k + 1) % polygon.size()];
    const double a = direction.dot(from) - limit, b = direction.dot(to) - limit;
    if (a <= 0.0) result.push_back(from);
    if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
      result.push_back(from + a / (a - b) * (to - from));
    }
  }
  return result.size() < 3 ? Polygon{} : result;
}

struct Extent {
  double low, high;
  double length() const { return high - low; }
};

Extent extent_of(const Polygon& polygon, const Vector3& direction) {
  const auto along = [&](const Vector3& a, const Vector3& b) {
    return direction.dot(a) < direction.dot(b);
  };
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), along);
  return {direction.dot(*low), direction.dot(*high)};
}

/// The polygon in strips of equal width across a direction.
std::vector<Polygon> strips(const Polygon& polygon, const Vector3& direction, int count) {
  const Extent extent = extent_of(polygon, direction);
  std::vector<Polygon> result;
  Polygon rest = polygon;
  for (int i = 1; i < count && !rest.empty(); ++i) {
    const double limit = extent.low + extent.length() * i / count;
    Polygon strip = clipped(rest, direction, limit);
    if (!strip.empty()) result.push_back(std::move(strip));
    rest = clipped(rest, -direction, -limit);
  }
  if (!rest.empty()) result.push_back(std::move(rest));
  return result;
}

int pieces_of(double length, double piece) {
  return std::max(1, static_cast<int>(std::ceil(length / piece)));
}

std::vector<Polygon> divided(const Polygon& polygon, double size) {
  Vector3 along = Vector3::Zero();
  Vector3 doubled_area = Vector3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3& next = polygon[(k + 1) % polygon.size()];
    const Vector3 edge = next - polygon[k];
    if (edge.squaredNorm() > along.squaredNorm()) along = edge;
    doubled_area += (polygon[k] - polygon[0]).cross(next - polygon[0]);
  }
  if (doubled_area.norm() == 0.0) return {polygon};
  const Vector3 u = along.normalized();
  const Vector3 v = doubled_area.normalized().cross(u);
  const double length = extent_of(polygon, u).length(), width = extent_of(polygon, v).length();
  if (std::hypot(length, width) <= size) return {polygon};
  // Squares, or rectangles as long as allowed where the panel is narrower than these.
  const double side = size / std::numbers::sqrt2;
  const int across =
      pieces_of(width, length < side ? std::sqrt(size * size - length * length) : side);
  const double height = width / across;
  const int lengthwise = pieces_of(length, std::sqrt(size * size - height * height));
  std::vector<Polygon> result;
  for (const Polygon& strip : strips(polygon, v, across)) {
    for (Polygon& piece : strips(strip, u, lengthwise)) result.push_back(std::move(piece));
  }
  return result;
}

}  // namespace

Hull divide_flat_panels(const Hull& hull, double size) {
  Hull result(hull.name());
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    Polygon polygon;
    for (const int vertex : hull.panel(panel)) polygon.push_back(hull.vertex(vertex));
    for (const Polygon& piece : divided(polygon, size)) {
      std::vector<int> corners;
      for (const Vector3& corner : piece) corners.push_back(result.add_vertex(corner));
      result.add_panel(corners);
    }
  }
  return result;
}

}  // namespace blocklift::dynamics
