#include "dynamics/marine/panels/panel_shapes.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw ModelError(std::string(what) + " is " + std::to_string(value) +
                     ": it must be a positive number");
  }
}

void require_count(int value, int least, const char* what) {
  if (value < least) {
    throw ModelError(std::string(what) + " is " + std::to_string(value) + ": at least " +
                     std::to_string(least) + " are needed");
  }
}

/// Points 0 .. 1 whose intervals grow geometrically from the last to the first by a ratio.
std::vector<double> graded_to_end(int intervals, double ratio) {
  std::vector<double> points(static_cast<std::size_t>(intervals) + 1);
  const double step = intervals > 1 ? std::pow(ratio, -1.0 / (intervals - 1)) : 1.0;
  double size = 1.0, sum = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k, size *= step) points[k] = sum += size;
  for (double& point : points) point /= sum;
  points.back() = 1.0;
  return points;
}

/// Points -1/2 .. 1/2, symmetric, finer towards both ends; the middle interval is longer by a
/// ratio.
std::vector<double> graded_to_both_ends(int intervals, double ratio) {
  std::vector<double> sizes(static_cast<std::size_t>(intervals));
  double sum = 0.0;
  for (int k = 0; k < intervals; ++k) {
    const double from_end = std::min(k, intervals - 1 - k);
    const double reach = std::max(1.0, 0.5 * (intervals - 1));
    sum += sizes[k] = std::pow(ratio, from_end / reach);
  }
  std::vector<double> points{-0.5};
  for (double size : sizes) points.push_back(points.back() + size / sum);
  for (std::size_t k = 0; 2 * k < points.size(); ++k) {  // symmetric to the last digit
    const double half = 0.5 * (points[points.size() - 1 - k] - points[k]);
    points[k] = -half;
    points[points.size() - 1 - k] = half;
  }
  return points;
}

/// Appends the panels of a grid of points; vertices that fall together make triangles.
void add_grid(int rows, int columns, const std::function<Vector3(int, int)>& point,
              std::vector<Panel>& panels) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const std::array<Vector3, 4> corners{point(i, j), point(i, j + 1), point(i + 1, j + 1),
                                           point(i + 1, j)};
      std::vector<Vector3> distinct;
      for (std::size_t k = 0; k < 4; ++k) {
        if ((corners[k] - corners[(k + 1) % 4]).norm() > 0.0) distinct.push_back(corners[k]);
      }
      panels.push_back(make_panel(distinct));
    }
  }
}

/// cos and sin of column j of n around, exact where the point lies on an axis.
std::array<double, 2> around(int j, int n) {
  const int eighth = 8 * (j % n);
  const int quadrant = (2 * eighth) / (4 * n);  // 0 .. 3
  const double angle = 2.0 * std::numbers::pi * (j % n) / n - quadrant * std::numbers::pi / 2;
  // Within the quadrant from the nearer axis, so that mirrored columns agree to the last digit.
  const double c =
      angle > std::numbers::pi / 4 ? std::sin(std::numbers::pi / 2 - angle) : std::cos(angle);
  const double s =
      angle > std::numbers::pi / 4 ? std::cos(std::numbers::pi / 2 - angle) : std::sin(angle);
  switch (quadrant) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// Panels of the lower half of a unit sphere, or with both halves; outward normals.
std::vector<Panel> unit_sphere(const RoundDivision& division, const Vector3& scale, bool whole) {
  require_count(division.meridians, 3, "the number of panels around");
  require_count(division.parallels, 1, "the number of panels downwards");
  require_positive(division.grading, "the grading of a round body");
  for (int axis = 0; axis < 3; ++axis) require_positive(scale[axis], "a semi-axis");
  const auto fractions = graded_to_end(division.parallels, whole ? 1.0 : division.grading);
  std::vector<Panel> panels;
  const auto point = [&](int i, int j, double upwards) -> Vector3 {
    const double polar = fractions[i] * std::numbers::pi / 2;
    const auto [c, s] = around(j, division.meridians);
    const bool at_equator = i == division.parallels;
    const double radius = i == 0 ? 0.0 : (at_equator ? 1.0 : std::sin(polar));
    const double depth = at_equator ? 0.0 : std::cos(polar);
    return scale.cwiseProduct(Vector3(radius * c, radius * s, upwards * depth));
  };
  add_grid(
      division.parallels, division.meridians, [&](int i, int j) { return point(i, j + 1, -1.0); },
      panels);
  // Seen from below the columns run clockwise: turn the panels round.
  for (Panel& panel : panels) {
    if (panel.normal.dot(panel.centroid) > 0.0) continue;
    std::vector<Vector3> points(panel.vertices.begin(),
                                panel.vertices.begin() + panel.vertex_count);
    std::reverse(points.begin(), points.end());
    panel = make_panel(points);
  }
  if (whole) {
    const std::size_t lower = panels.size();
    for (std::size_t k = 0; k < lower; ++k) {
      std::vector<Vector3> points;
      for (int v = panels[k].vertex_count; v-- > 0;) {
        const Vector3& p = panels[k].vertices[v];
        points.emplace_back(p.x(), p.y(), -p.z());
      }
      panels.push_back(make_panel(points));
    }
  }
  return panels;
}

PanelMesh scaled(const PanelMesh& mesh, double factor) {
  PanelMesh result{{}, mesh.symmetry};
  for (const Panel& panel : mesh.panels) {
    std::vector<Vector3> points;
    for (int k = 0; k < panel.vertex_count; ++k) {
      points.push_back(factor * panel.vertices[k]);
    }
    result.panels.push_back(make_panel(points));
  }
  return result;
}

}  // namespace

PanelMesh make_half_ellipsoid(const Vector3& semi_axes, const RoundDivision& division) {
  PanelMesh mesh = make_panel_mesh(unit_sphere(division, semi_axes, false));
  if (!division.exact_volume) return mesh;
  const double volume = 2.0 / 3.0 * std::numbers::pi * semi_axes.prod();
  return scaled(mesh, std::cbrt(volume / mesh.displaced_volume()));
}

PanelMesh make_ellipsoid(const Vector3& semi_axes, const Vector3& centre,
                         const RoundDivision& division) {
  PanelMesh mesh = make_panel_mesh(unit_sphere(division, semi_axes, true));
  if (division.exact_volume) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
    mesh = scaled(mesh, std::cbrt(volume / mesh.displaced_volume()));
  }
  return translate(mesh, centre);
}

PanelMesh make_vertical_cylinder(double radius, double draught, bool closed,
                                 const RoundDivision& division) {
  require_positive(radius, "the radius of the cylinder");
  require_positive(draught, "the draught of the cylinder");
  require_count(division.meridians, 3, "the number of panels around");
  require_count(division.parallels, 1, "the number of panels downwards");
  const int n = division.meridians;
  // A polygon of the circle's area.
  const double angle = 2.0 * std::numbers::pi / n;
  const double r = division.exact_volume
                       ? radius * std::sqrt(2.0 * std::numbers::pi / (n * std::sin(angle)))
                       : radius;
  const bool graded_edge = closed && division.graded_edge;
  auto depth = graded_to_end(division.parallels, division.grading);
  if (graded_edge) {
    depth = graded_to_both_ends(division.parallels, division.grading);
    for (double& fraction : depth) fraction += 0.5;
  }
  std::vector<Panel> panels;
  const auto side = [&](int i, int j) -> Vector3 {
    const auto [c, s] = around(j, n);
    return {r * c, r * s, draught * (depth[i] - 1.0)};
  };
  add_grid(division.parallels, n, side, panels);
  if (closed) {
    const int rings = graded_edge ? std::max(2, 5 * n / 16) : std::max(2, n / 6);
    const auto radii = graded_to_end(rings, graded_edge ? division.grading : 1.0);
    const auto bottom = [&](int i, int j) -> Vector3 {
      const auto [c, s] = around(n - j, n);
      const double fraction = i == 0 ? 0.0 : radii[i];
      return {r * fraction * c, r * fraction * s, -draught};
    };
    std::vector<Panel> lid;
    add_grid(
        rings, n, [&](int i, int j) { return bottom(rings - i, n - j); }, lid);
    for (Panel& panel : lid) {
      if (panel.normal.z() > 0.0) {
        std::vector<Vector3> points(panel.vertices.begin(),
                                    panel.vertices.begin() + panel.vertex_count);
        std::reverse(points.begin(), points.end());
        panel = make_panel(points);
      }
      panels.push_back(panel);
    }
  }
  return make_panel_mesh(std::move(panels));
}

PanelMesh make_ring(double outer_radius, double inner_radius, double draught,
                    const RoundDivision& division) {
  require_positive(inner_radius, "the inner radius of the ring");
  require_positive(outer_radius - inner_radius, "the breadth of the ring");
  require_positive(draught, "the draught of the ring");
  require_count(division.meridians, 3, "the number of panels around");
  require_count(division.parallels, 1, "the number of panels downwards");
  const int n = division.meridians, parallels = division.parallels;
  const double angle = 2.0 * std::numbers::pi / n;
  const double scale =
      division.exact_volume ? std::sqrt(2.0 * std::numbers::pi / (n * std::sin(angle))) : 1.0;
  const double outer = scale * outer_radius, inner = scale * inner_radius;
  const int rings = std::max(2, static_cast<int>(std::ceil(parallels * (outer - inner) / draught)));
  const auto depth = graded_to_both_ends(parallels, division.grading);
  const auto breadth = graded_to_both_ends(rings, division.grading);
  const auto at = [&](double radius, double z, int j) -> Vector3 {
    const auto [c, s] = around(((j % n) + n) % n, n);
    return {radius * c, radius * s, z};
  };
  const auto height = [&](int i) { return draught * (depth[i] - 0.5); };
  std::vector<Panel> panels;
  add_grid(
      parallels, n, [&](int i, int j) { return at(outer, height(i), j); }, panels);
  add_grid(
      parallels, n, [&](int i, int j) { return at(inner, height(i), n - j); }, panels);
  const auto bottom = [&](int i, int j) {
    const double share = breadth[i] + 0.5;
    return at(inner + share * (outer - inner), -draught, j);
  };
  add_grid(rings, n, bottom, panels);
  return make_panel_mesh(std::move(panels));
}

PanelMesh make_box_hull(double length, double breadth, double draught,
                        const BoxDivision& division) {
  require_positive(length, "the length of the box");
  require_positive(breadth, "the breadth of the box");
  require_positive(draught, "the draught of the box");
  require_count(division.length, 1, "the number of panels along the box");
  require_count(division.breadth, 1, "the number of panels across the box");
  require_count(division.draught, 1, "the number of panels down the box");
  require_positive(division.grading, "the grading of a box");
  const auto x = graded_to_both_ends(division.length, division.grading);
  const auto y = graded_to_both_ends(division.breadth, division.grading);
  const auto z = graded_to_both_ends(division.draught, division.grading);
  const auto at = [](const std::vector<double>& points, int k) { return points[k]; };
  const auto depth = [&](int k) { return draught * (at(z, k) - 0.5); };
  std::vector<Panel> panels;
  const int nx = division.length, ny = division.breadth, nz = division.draught;
  add_grid(
      ny, nx,
      [&](int i, int j) { return Vector3(length * at(x, j), -breadth * at(y, i), -draught); },
      panels);
  for (const double side : {-1.0, 1.0}) {
    add_grid(
        nz, nx,
        [&](int i, int j) {
          return Vector3(-side * length * at(x, j), side * breadth / 2, depth(i));
        },
        panels);
    add_grid(
        nz, ny,
        [&](int i, int j) {
          return Vector3(side * length / 2, side * breadth * at(y, j), depth(i));
        },
        panels);
  }
  return make_panel_mesh(std::move(panels));
}

PanelMesh translate(const PanelMesh& mesh, const Vector3& p_W) {
  if ((mesh.symmetry.x && p_W.x() != 0.0) || (mesh.symmetry.y && p_W.y() != 0.0)) {
    throw ModelError("a mesh cannot be moved off its own plane of symmetry: expand it first");
  }
  PanelMesh result = mesh;
  for (Panel& panel : result.panels) {
    for (Vector3& vertex : panel.vertices) vertex += p_W;
    panel.centroid += p_W;
  }
  return result;
}

}  // namespace blocklift::dynamics
