#include "dynamics/marine/hull/hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_edges.h"
#include "dynamics/marine/hull/point_text.h"

namespace blocklift::dynamics {

int Hull::add_vertex(const Vector3& p_BoV_B) {
  vertices_.push_back(p_BoV_B);
  return static_cast<int>(vertices_.size()) - 1;
}

void Hull::add_panel(std::span<const int> vertices) {
  const std::string place = "hull \"" + name_ + "\", panel " + std::to_string(panel_count());
  if (vertices.size() < 3) {
    throw ModelError(place + " has " + std::to_string(vertices.size()) +
                     " vertices; three or more are due");
  }
  for (const int vertex : vertices) {
    if (vertex < 0 || vertex >= static_cast<int>(vertices_.size())) {
      throw ModelError(place + " has the vertex " + std::to_string(vertex) + "; there are " +
                       std::to_string(vertices_.size()) + ", counted from 0");
    }
  }
  corners_.insert(corners_.end(), vertices.begin(), vertices.end());
  start_.push_back(corners_.size());
}

std::array<Vector3, 3> Hull::triangle(int panel, int number) const {
  const std::span<const int> corners = this->panel(panel);
  const auto i = static_cast<std::size_t>(number);
  return {vertex(corners[0]), vertex(corners[i + 1]), vertex(corners[i + 2])};
}

Vector3 Hull::panel_area_vector(int panel) const {
  const int triangles = static_cast<int>(this->panel(panel).size()) - 2;
  Vector3 area = Vector3::Zero();
  for (int i = 0; i < triangles; ++i) {
    const auto [a, b, c] = triangle(panel, i);
    area += 0.5 * (b - a).cross(c - a);
  }
  return area;
}

Vector3 Hull::panel_midpoint(int panel) const {
  Vector3 sum = Vector3::Zero();
  for (const int corner : this->panel(panel)) sum += vertex(corner);
  return sum / static_cast<double>(this->panel(panel).size());
}

double Hull::panel_diameter(int panel) const {
  double largest = 0.0;
  for (const int a : this->panel(panel)) {
    for (const int b : this->panel(panel)) {
      largest = std::max(largest, (vertex(a) - vertex(b)).norm());
    }
  }
  return largest;
}

std::array<Vector3, 2> Hull::bounds() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<Vector3, 2> box = {Vector3::Constant(infinity), Vector3::Constant(-infinity)};
  for (const Vector3& p : vertices_) {
    box[0] = box[0].cwiseMin(p);
    box[1] = box[1].cwiseMax(p);
  }
  return box;
}

EnclosedVolume calc_enclosed_volume(const Hull& hull) {
  // Seen from the middle of the hull, not from an origin that may lie far off.
  const auto box = hull.bounds();
  const Vector3 origin = 0.5 * (box[0] + box[1]);
  double volume = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();  // integral of p p^T
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const int triangles = static_cast<int>(hull.panel(panel).size()) - 2;
    for (int i = 0; i < triangles; ++i) {
      auto [a, b, c] = hull.triangle(panel, i);
      a -= origin, b -= origin, c -= origin;
      const double six_volumes = a.dot(b.cross(c));
      const Vector3 sum = a + b + c;
      volume += six_volumes / 6.0;
      first += six_volumes / 24.0 * sum;
      second += six_volumes / 120.0 *
                (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  }
  const Vector3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  const Matrix3 inertia = second.trace() * Matrix3::Identity() - second;
  return {volume, origin + centre, Symmetric3::of(inertia)};
}

namespace {

// A hull with the panels of another, its vertices displaced and numbered anew by `vertex_of`. Those
// that are reversed keep their first vertex, from which warped ones are divided into triangles: an
// image divided along the other diagonal would be another hull.
template <class VertexOf>
void add_panels(const Hull& from, VertexOf&& vertex_of, bool reversed, Hull& to) {
  std::vector<int> corners;
  for (int panel = 0; panel < from.panel_count(); ++panel) {
    corners.clear();
    for (const int corner : from.panel(panel)) corners.push_back(vertex_of(corner));
    if (reversed) std::reverse(corners.begin() + 1, corners.end());
    to.add_panel(corners);
  }
}

}  // namespace

Hull transform(const Pose& X_AB, const Hull& hull_B) {
  Hull hull(hull_B.name());
  for (const Vector3& p : hull_B.vertices()) hull.add_vertex(X_AB.apply(p));
  add_panels(
      hull_B, [](int corner) { return corner; }, false, hull);
  return hull;
}

Hull reverse(const Hull& hull) {
  Hull turned(hull.name());
  for (const Vector3& p : hull.vertices()) turned.add_vertex(p);
  add_panels(
      hull, [](int corner) { return corner; }, true, turned);
  return turned;
}

namespace {

// For each vertex the one that stands for it: the first within the tolerance, found in a grid.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vector3>& vertices, double tolerance)
      : vertices_(vertices), tolerance_(tolerance) {}

  int find_or_add(int vertex) {
    const Vector3& p = vertices_[vertex];
    const std::array<long, 3> cell = cell_of(p);
    for (long i = cell[0] - 1; i <= cell[0] + 1; ++i) {
      for (long j = cell[1] - 1; j <= cell[1] + 1; ++j) {
        for (long k = cell[2] - 1; k <= cell[2] + 1; ++k) {
          const auto found = cells_.find({i, j, k});
          if (found == cells_.end()) continue;
          for (const int other : found->second) {
            if ((vertices_[other] - p).norm() <= tolerance_) return other;
          }
        }
      }
    }
    cells_[cell].push_back(vertex);
    return vertex;
  }

 private:
  std::array<long, 3> cell_of(const Vector3& p) const {
    const double size = std::max(tolerance_, 1e-12);
    return {std::lround(p.x() / size), std::lround(p.y() / size), std::lround(p.z() / size)};
  }

  const std::vector<Vector3>& vertices_;
  double tolerance_;
  std::map<std::array<long, 3>, std::vector<int>> cells_;
};

}  // namespace

Hull merge_vertices(const Hull& hull, double tolerance) {
  VertexGrid grid(hull.vertices(), tolerance);
  Hull merged(hull.name());
  std::vector<int> number(hull.vertices().size(), -1);
  for (std::size_t i = 0; i < number.size(); ++i) {
    const int first = grid.find_or_add(static_cast<int>(i));
    number[i] =
        first == static_cast<int>(i) ? merged.add_vertex(hull.vertices()[i]) : number[first];
  }
  std::vector<int> corners;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    corners.clear();
    for (const int corner : hull.panel(panel)) {
      const int vertex = number[corner];
      if (corners.empty() || corners.back() != vertex) corners.push_back(vertex);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() >= 3) merged.add_panel(corners);
  }
  return merged;
}

Hull with_mirror_image(const Hull& hull, int axis, double tolerance) {
  Hull both(hull.name());
  for (const Vector3& p : hull.vertices()) both.add_vertex(p);
  for (Vector3 p : hull.vertices()) {
    p[axis] = -p[axis];
    both.add_vertex(p);
  }
  const int count = static_cast<int>(hull.vertices().size());
  add_panels(
      hull, [](int corner) { return corner; }, false, both);
  add_panels(
      hull, [count](int corner) { return corner + count; }, true, both);
  return merge_vertices(both, tolerance);
}

namespace {

// Six times the volume between a panel and Bo.
double six_volumes(const Hull& hull, int panel) {
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(hull.panel(panel).size()) - 2; ++i) {
    const auto [a, b, c] = hull.triangle(panel, i);
    sum += a.dot(b.cross(c));
  }
  return sum;
}

}  // namespace

Hull turned_outwards(const Hull& hull) {
  struct Neighbour {
    int panel;
    bool opposed;
  };
  const auto count = static_cast<std::size_t>(hull.panel_count());
  std::vector<std::vector<Neighbour>> neighbours(count);
  for (const auto& [edge, sides] : find_edges(hull)) {
    if (sides.size() != 2) continue;
    const bool opposed = sides[0].is_forward == sides[1].is_forward;
    neighbours[sides[0].panel].push_back({sides[1].panel, opposed});
    neighbours[sides[1].panel].push_back({sides[0].panel, opposed});
  }
  std::vector<int> sense(count, 0);  // 1: as it is, -1: turned, 0: not yet seen
  for (std::size_t first = 0; first < count; ++first) {
    if (sense[first] != 0) continue;
    std::vector<int> part = {static_cast<int>(first)};
    sense[first] = 1;
    double volume = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto panel = static_cast<std::size_t>(part[i]);
      volume += sense[panel] * six_volumes(hull, part[i]);
      for (const Neighbour& n : neighbours[panel]) {
        int& other = sense[n.panel];
        if (other != 0) continue;
        other = n.opposed ? -sense[panel] : sense[panel];
        part.push_back(n.panel);
      }
    }
    if (volume >= 0.0) continue;
    for (const int panel : part) sense[panel] *= -1;
  }
  Hull turned(hull.name());
  for (const Vector3& p : hull.vertices()) turned.add_vertex(p);
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    std::vector<int> corners(hull.panel(panel).begin(), hull.panel(panel).end());
    if (sense[panel] < 0) std::reverse(corners.begin(), corners.end());
    turned.add_panel(corners);
  }
  return turned;
}

namespace {

// Edges that one panel has and no other has in the opposite sense: from vertex to vertex.
std::map<int, std::vector<int>> find_rim(const Hull& hull) {
  std::map<int, std::vector<int>> rim;
  for (const auto& [edge, panels] : find_edges(hull)) {
    const auto forward = std::ranges::count_if(panels, &PanelAtEdge::is_forward);
    const auto backward = static_cast<std::ptrdiff_t>(panels.size()) - forward;
    if (forward > backward) rim[edge[1]].push_back(edge[0]);  // the lid runs the other way
    if (forward < backward) rim[edge[0]].push_back(edge[1]);
  }
  return rim;
}

// Takes one closed loop out of the rim.
std::vector<int> take_loop(const Hull& hull, std::map<int, std::vector<int>>& rim) {
  const int first = rim.begin()->first;
  std::vector<int> loop;
  int vertex = first;
  do {
    const auto next = rim.find(vertex);
    if (next == rim.end()) {
      throw ModelError("hull \"" + hull.name() + "\": the rim of an opening ends at the vertex " +
                       text_of_point(hull.vertex(vertex)) +
                       " and does not come back to where it began");
    }
    loop.push_back(vertex);
    vertex = next->second.back();
    next->second.pop_back();
    if (next->second.empty()) rim.erase(next);
  } while (vertex != first);
  return loop;
}

void require_flat(const Hull& hull, const std::vector<int>& loop, const Vector3& middle,
                  double tolerance) {
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3 a = hull.vertex(loop[i]) - middle;
    area += a.cross(hull.vertex(loop[(i + 1) % loop.size()]) - middle);
  }
  const Vector3 normal = area.normalized();
  for (const int vertex : loop) {
    const double distance = std::abs(normal.dot(hull.vertex(vertex) - middle));
    if (distance <= tolerance) continue;
    throw ModelError("hull \"" + hull.name() +
                     "\": the rim of an opening is not flat, its vertex " +
                     text_of_point(hull.vertex(vertex)) + " lies " + std::to_string(distance) +
                     " m off its plane; close the hull in the program that made the mesh");
  }
}

}  // namespace

Hull with_lids(const Hull& hull, double tolerance) {
  Hull closed = hull;
  std::map<int, std::vector<int>> rim = find_rim(hull);
  while (!rim.empty()) {
    const std::vector<int> loop = take_loop(hull, rim);
    Vector3 middle = Vector3::Zero();
    for (const int vertex : loop) middle += hull.vertex(vertex);
    middle /= static_cast<double>(loop.size());
    require_flat(hull, loop, middle, tolerance);
    const int centre = closed.add_vertex(middle);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      closed.add_panel({centre, loop[i], loop[(i + 1) % loop.size()]});
    }
  }
  return closed;
}

}  // namespace blocklift::dynamics
