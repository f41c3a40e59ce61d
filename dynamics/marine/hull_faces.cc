#include "dynamics/marine/hull_faces.h"

#include <algorithm>
#include <map>
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

/// Both faces as one, b having the edge that follows a's corner `from` the other way round; none if they
/// do not lie in one plane or are not convex together.
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

}  // namespace blocklift::dynamics
