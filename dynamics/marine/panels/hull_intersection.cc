#include "dynamics/marine/panels/hull_intersection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace blocklift::dynamics {
namespace {

using Triangle = std::array<Vector3, 3>;
using Surface = std::span<const Triangle>;

struct Box {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;

  void include(const Vector3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

Box box_of(const Triangle& triangle) {
  Box box;
  for (const Vector3& p : triangle) box.include(p);
  return box;
}

/// Those that reach into a box.
Triangles within(Surface surface, const Box& box) {
  Triangles result;
  for (const Triangle& triangle : surface) {
    if (box_of(triangle).meets(box)) result.push_back(triangle);
  }
  return result;
}

Box box_of(Surface surface) {
  Box box;
  for (const Triangle& triangle : surface) {
    for (const Vector3& p : triangle) box.include(p);
  }
  return box;
}

/// Does a point of the triangle's plane lie in it, or to rounding on its edge?
bool covers(const Triangle& t, const Vector3& n, const Vector3& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 edge = t[(k + 1) % 3] - t[k];
    if (n.dot(edge.cross(p - t[k])) < -1e-9 * n.squaredNorm()) return false;
  }
  return true;
}

/// Where the edge from p to q goes through a triangle from one side to the other.
std::optional<Vector3> passage(const Vector3& p, const Vector3& q, const Triangle& t) {
  const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above = n.dot(p - t[0]), below = n.dot(q - t[0]);
  const double rounding = 1e-9 * n.norm() * ((q - p).norm() + (t[1] - t[0]).norm());
  if (!(above > rounding && below < -rounding) && !(above < -rounding && below > rounding)) {
    return std::nullopt;
  }
  const Vector3 place = p + above / (above - below) * (q - p);
  if (!covers(t, n, place)) return std::nullopt;
  return place;
}

std::optional<Vector3> find_passage(Surface edges, Surface surface) {
  std::vector<Box> boxes;
  for (const Triangle& triangle : surface) boxes.push_back(box_of(triangle));
  for (const Triangle& triangle : edges) {
    const Box box = box_of(triangle);
    for (std::size_t k = 0; k < surface.size(); ++k) {
      if (!box.meets(boxes[k])) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        if (auto place = passage(triangle[e], triangle[(e + 1) % 3], surface[k])) return place;
      }
    }
  }
  return std::nullopt;
}

/// Times that the line straight down from a point leaves the surface less those that it enters it.
/// Triangles that it meets in their outline count by the half-open rule, so that none counts twice.
int net_exits_below(Surface surface, const Vector3& p) {
  int exits = 0;
  for (const Triangle& t : surface) {
    bool inside = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 &a = t[k], &b = t[(k + 1) % 3];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (p.x() < x) inside = !inside;
    }
    const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (!inside || n.z() == 0.0) continue;
    const double z = t[0].z() - (n.x() * (p.x() - t[0].x()) + n.y() * (p.y() - t[0].y())) / n.z();
    if (z < p.z()) exits += n.z() < 0.0 ? 1 : -1;
  }
  return exits;
}

/// A point of one body, just within its surface, that lies in the other too.
std::optional<Vector3> find_common(Surface some, Surface other) {
  for (const Triangle& t : some) {
    const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (n.isZero(0.0)) continue;
    const Vector3 middle = (t[0] + t[1] + t[2]) / 3.0;
    const Vector3 within_body = middle - 1e-6 / std::sqrt(n.norm()) * n;
    if (net_exits_below(other, within_body) > 0) return middle;
  }
  return std::nullopt;
}

}  // namespace

Triangles triangles_of(const Hull& hull, const Pose& X_WB) {
  Triangles result;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const int count = static_cast<int>(hull.panel(panel).size()) - 2;
    for (int number = 0; number < count; ++number) {
      Triangle triangle = hull.triangle(panel, number);
      for (Vector3& p : triangle) p = X_WB.apply(p);
      result.push_back(triangle);
    }
  }
  return result;
}

Triangles triangles_of(const PanelMesh& mesh) {
  Triangles result;
  for (const Panel& panel : expand_symmetry(mesh).panels) {
    const auto& v = panel.vertices;
    result.push_back({v[0], v[1], v[2]});
    if (panel.vertex_count == 4) result.push_back({v[0], v[2], v[3]});
  }
  return result;
}

std::optional<Vector3> find_intersection(Surface first, Surface second) {
  const Box first_box = box_of(first), second_box = box_of(second);
  if (!first_box.meets(second_box)) return std::nullopt;
  const Triangles of_first = within(first, second_box), of_second = within(second, first_box);
  if (auto place = find_passage(of_first, of_second)) return place;
  if (auto place = find_passage(of_second, of_first)) return place;
  if (auto place = find_common(of_first, second)) return place;
  return find_common(of_second, first);
}

}  // namespace blocklift::dynamics
