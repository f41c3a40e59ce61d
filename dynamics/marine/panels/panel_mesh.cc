#include "dynamics/marine/panels/panel_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/point_text.h"
#include "dynamics/marine/panels/plane_polygon.h"

namespace blocklift::dynamics {
namespace {

/// Vertices of a quadrangle moved along the normal into its mean plane.
void flatten(Panel& panel) {
  const Vector3 centre =
      (panel.vertices[0] + panel.vertices[1] + panel.vertices[2] + panel.vertices[3]) / 4.0;
  for (Vector3& vertex : panel.vertices) {
    vertex -= panel.normal * panel.normal.dot(vertex - centre);
  }
}

/// Signed area (m2, positive where a, b, c run counter-clockwise about the normal).
double signed_area(const Vector3& normal, const Vector3& a, const Vector3& b, const Vector3& c) {
  return 0.5 * normal.dot((b - a).cross(c - a));
}

void set_area_and_centroid(Panel& panel) {
  const auto& v = panel.vertices;
  const double first = signed_area(panel.normal, v[0], v[1], v[2]);
  const double second = panel.vertex_count == 4 ? signed_area(panel.normal, v[0], v[2], v[3]) : 0.0;
  panel.area = first + second;
  panel.centroid =
      (first * (v[0] + v[1] + v[2]) + second * (v[0] + v[2] + v[3])) / (3.0 * panel.area);
}

Panel reflected(const Panel& panel, const Symmetry& symmetry, int image) {
  Panel result = panel;
  const auto count = static_cast<std::size_t>(panel.vertex_count);
  for (std::size_t k = 0; k < count; ++k) {
    result.vertices[k] = symmetry.reflect(image, panel.vertices[k]);
  }
  const bool mirrored = symmetry.reflect(image, {1, 1, 1}).prod() < 0.0;
  if (mirrored) std::reverse(result.vertices.begin(), result.vertices.begin() + panel.vertex_count);
  if (count == 3) result.vertices[3] = result.vertices[2];
  result.normal = symmetry.reflect(image, panel.normal);
  result.centroid = symmetry.reflect(image, panel.centroid);
  return result;
}

/// A panel's edge in the plane z = 0.
struct Edge {
  Vector3 from, to;
  bool used = false;
};

std::vector<Edge> edges_at_surface(const PanelMesh& whole) {
  std::vector<Edge> edges;
  for (const Panel& panel : whole.panels) {
    const double tolerance = 1e-6 * panel.diameter();
    if (std::abs(panel.normal.z()) > 1.0 - 1e-9) continue;  // a lid or a bottom at z = 0
    for (int k = 0; k < panel.vertex_count; ++k) {
      const Vector3& from = panel.vertices[k];
      const Vector3& to = panel.vertices[(k + 1) % panel.vertex_count];
      if (std::abs(from.z()) > tolerance || std::abs(to.z()) > tolerance) continue;
      edges.push_back({Vector3(from.x(), from.y(), 0.0), Vector3(to.x(), to.y(), 0.0)});
    }
  }
  return edges;
}

/// Lines counter-clockwise, but for those that an odd number of the hull's other lines holds: they
/// are openings.
void turn_lines(std::vector<WaterLine>& lines) {
  std::vector<PlanePolygon> polygons;
  for (const WaterLine& line : lines) polygons.push_back(to_polygon(line));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    bool is_opening = false;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      if (j != k && contains(polygons[j], polygons[k][0])) is_opening = !is_opening;
    }
    if ((enclosed_area(lines[k]) < 0.0) != is_opening)
      std::reverse(lines[k].begin(), lines[k].end());
  }
}

/// The unused edge that starts at a point, or nothing.
Edge* continue_at(std::vector<Edge>& edges, const Vector3& point, double tolerance) {
  for (Edge& edge : edges) {
    if (!edge.used && (edge.from - point).norm() < tolerance) return &edge;
  }
  return nullptr;
}

}  // namespace

double Panel::diameter() const {
  double squared = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      squared = std::max(squared, (vertices[i] - vertices[j]).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

Panel make_panel(std::span<const Vector3> points) {
  if (points.size() != 3 && points.size() != 4) {
    throw ModelError("a panel of " + std::to_string(points.size()) +
                     " vertices: a panel has 3 or 4; divide it");
  }
  Panel panel;
  panel.vertex_count = static_cast<int>(points.size());
  std::copy(points.begin(), points.end(), panel.vertices.begin());
  if (points.size() == 3) panel.vertices[3] = points[2];
  const Vector3 normal = points.size() == 3
                             ? (points[1] - points[0]).cross(points[2] - points[0]).eval()
                             : (points[2] - points[0]).cross(points[3] - points[1]).eval();
  const double diameter = panel.diameter();
  if (!normal.allFinite()) throw ModelError("a panel's vertex is not a finite number");
  if (!(normal.norm() > 1e-12 * diameter * diameter)) {
    throw ModelError("the panel at " + text_of_point(points[0]) +
                     " has no area: remove it, or repair the surface there");
  }
  panel.normal = normal.normalized();
  if (points.size() == 4) flatten(panel);
  set_area_and_centroid(panel);
  return panel;
}

Vector3 Symmetry::reflect(int image, const Vector3& p_W) const {
  const bool across_x = x && (image & 1) != 0;
  const bool across_y = y && (x ? (image & 2) != 0 : (image & 1) != 0);
  return {across_x ? -p_W.x() : p_W.x(), across_y ? -p_W.y() : p_W.y(), p_W.z()};
}

double PanelMesh::total_area() const {
  const double part = std::accumulate(panels.begin(), panels.end(), 0.0,
                                      [](double sum, const Panel& p) { return sum + p.area; });
  return symmetry.image_count() * part;
}

double PanelMesh::displaced_volume() const {
  double part = 0.0;
  for (const Panel& panel : panels) part += panel.centroid.z() * panel.normal.z() * panel.area;
  return symmetry.image_count() * part;
}

PanelMesh make_panel_mesh(std::vector<Panel> panels, const Symmetry& symmetry) {
  return {std::move(panels), symmetry};
}

PanelMesh restrict_to_symmetry(const PanelMesh& whole, const Symmetry& symmetry) {
  PanelMesh part{{}, symmetry};
  for (const Panel& panel : whole.panels) {
    const double tolerance = 1e-6 * panel.diameter();
    for (int axis = 0; axis < 2; ++axis) {
      if (!(axis == 0 ? symmetry.x : symmetry.y)) continue;
      double lowest = 0.0, highest = 0.0;
      for (const Vector3& vertex : panel.vertices) {
        lowest = std::min(lowest, vertex[axis]);
        highest = std::max(highest, vertex[axis]);
      }
      if (lowest < -tolerance && highest > tolerance) {
        throw ModelError("the panel at " + text_of_point(panel.centroid) +
                         " crosses the plane of symmetry " + (axis == 0 ? "x" : "y") +
                         " = 0: panels must end at the plane, or do without that symmetry");
      }
    }
    if ((symmetry.x && panel.centroid.x() < 0.0) || (symmetry.y && panel.centroid.y() < 0.0)) {
      continue;
    }
    part.panels.push_back(panel);
  }
  const double area = whole.total_area(), volume = std::abs(whole.displaced_volume());
  if (std::abs(part.total_area() - area) > 1e-6 * area ||
      std::abs(std::abs(part.displaced_volume()) - volume) >
          1e-6 * (volume + std::pow(area, 1.5))) {
    std::ostringstream message;
    message << "the surface is not symmetric: its area is " << area << " m2 and its volume "
            << volume << " m3, but the part that is kept would give " << part.total_area()
            << " m2 and " << std::abs(part.displaced_volume()) << " m3; do without that symmetry";
    throw ModelError(message.str());
  }
  return part;
}

PanelMesh expand_symmetry(const PanelMesh& part) {
  PanelMesh whole;
  for (int image = 0; image < part.symmetry.image_count(); ++image) {
    for (const Panel& panel : part.panels) {
      whole.panels.push_back(reflected(panel, part.symmetry, image));
    }
  }
  return whole;
}

std::vector<WaterLine> find_water_lines(const PanelMesh& hull) {
  std::vector<Edge> edges = edges_at_surface(expand_symmetry(hull));
  std::vector<WaterLine> lines;
  for (Edge& start : edges) {
    if (start.used) continue;
    WaterLine line;
    Edge* edge = &start;
    const double tolerance = 1e-4 * (start.to - start.from).norm();
    do {
      edge->used = true;
      line.push_back(edge->from);
      if ((edge->to - start.from).norm() < tolerance) break;
      Edge* next = continue_at(edges, edge->to, tolerance);
      if (next == nullptr) {
        throw ModelError("the hull's panels leave a gap in the water line at " +
                         text_of_point(edge->to) + ": each edge at z = 0 must meet the next");
      }
      edge = next;
    } while (true);
    lines.push_back(std::move(line));
  }
  turn_lines(lines);
  return lines;
}

double enclosed_area(const WaterLine& water_line) {
  double doubled = 0.0;
  for (std::size_t k = 0; k < water_line.size(); ++k) {
    doubled += water_line[k].cross(water_line[(k + 1) % water_line.size()]).z();
  }
  return 0.5 * doubled;
}

}  // namespace blocklift::dynamics
