#include "pipeline/measures/solids.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "algebra/decompositions.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::pipeline {

namespace {

void add_quad(const std::array<Vector3, 4>& corners, std::vector<Triangle>& triangles) {
  triangles.push_back({corners[0], corners[1], corners[2]});
  triangles.push_back({corners[0], corners[2], corners[3]});
}

void add_plates(const PlateModel& plate, std::vector<Triangle>& triangles) {
  const std::size_t n = plate.normal, u = (n + 1) % 3, v = (n + 2) % 3;
  if (!plate.extent[u] || !plate.extent[v]) return;
  for (const double at : plate.at) {
    std::array<Vector3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i][n] = at;
      corners[i][u] = plate.extent[u]->value[i == 1 || i == 2 ? 1 : 0];
      corners[i][v] = plate.extent[v]->value[i >= 2 ? 1 : 0];
    }
    add_quad(corners, triangles);
  }
}

/// A plane polygon; one that is not convex is covered and a little more.
void add_polygon(const std::vector<Vector3>& corners, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// Points of an arc from the first of three points through the second to the third.
std::vector<Vector3> divide_arc(const std::vector<Vector3>& points) {
  constexpr int pieces = 16;
  const Vector3 &a = points[0], &b = points[1], &c = points[2];
  const Vector3 normal = (b - a).cross(c - a);
  if (normal.norm() == 0) return points;
  // The centre is as far from all three, in their plane.
  Eigen::Matrix3d rows;
  rows << (b - a).transpose(), (c - a).transpose(), normal.transpose();
  const Vector3 right(0.5 * (b.squaredNorm() - a.squaredNorm()),
                      0.5 * (c.squaredNorm() - a.squaredNorm()), normal.dot(a));
  const Vector3 centre = algebra::solve_square(rows, right);
  const Vector3 axis = normal.normalized(), x = a - centre, y = axis.cross(x);
  double angle = std::atan2((c - centre).dot(y), (c - centre).dot(x));
  if (angle <= 0) angle += 2 * std::acos(-1.0);
  std::vector<Vector3> divided;
  for (int i = 0; i <= pieces; ++i) {
    const double turned = angle * i / pieces;
    divided.emplace_back(centre + std::cos(turned) * x + std::sin(turned) * y);
  }
  return divided;
}

/// The point at a share of a polyline's length.
Vector3 point_along(const std::vector<Vector3>& line, double share) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  double left = share * length;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = (line[i] - line[i - 1]).norm();
    if (left <= piece && piece > 0) return line[i - 1] + left / piece * (line[i] - line[i - 1]);
    left -= piece;
  }
  return line.back();
}

/// A plate that is ruled between two edges.
void add_ruled(const std::vector<EdgeModel>& edges, std::vector<Triangle>& triangles) {
  std::array<std::vector<Vector3>, 2> lines;
  for (std::size_t side = 0; side < 2; ++side)
    lines[side] = edges[side].is_arc && edges[side].points.size() == 3
                      ? divide_arc(edges[side].points)
                      : edges[side].points;
  const std::size_t pieces = 4 * (std::max(lines[0].size(), lines[1].size()) - 1);
  const auto at = [&](std::size_t side, std::size_t i) {
    return point_along(lines[side], static_cast<double>(i) / static_cast<double>(pieces));
  };
  for (std::size_t i = 0; i < pieces; ++i)
    add_quad({at(0, i), at(0, i + 1), at(1, i + 1), at(1, i)}, triangles);
}

/// A bar as a prism about its centroid, as wide and high as the points of its middle's section
/// reach; a square of its area where those are not known.
void add_bar(const structure::Mesh& mesh, const structure::Beam& beam,
             std::vector<Triangle>& triangles) {
  const structure::BeamSection section = structure::section_at(mesh, beam, 0.5);
  std::array<Vector3, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) ends[i] = mesh.vertices[beam.vertices[i]] + beam.offset[i];
  const Vector3 axis_1 = (ends[1] - ends[0]).normalized();
  const Vector3 axis_2 = (beam.axis_2 - beam.axis_2.dot(axis_1) * axis_1).normalized();
  const Vector3 axis_3 = axis_1.cross(axis_2);
  Eigen::AlignedBox2d reach;
  for (const Eigen::Vector2d& point : section.stress_points) reach.extend(point);
  const double half = 0.5 * std::sqrt(section.area);
  if (reach.isEmpty() || !(reach.sizes().minCoeff() > 0))
    reach = Eigen::AlignedBox2d(Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, half));
  const auto corner = [&](std::size_t end, int i) {
    const double x_2 = i == 1 || i == 2 ? reach.max().x() : reach.min().x();
    const double x_3 = i >= 2 ? reach.max().y() : reach.min().y();
    return Vector3(ends[end] + x_2 * axis_2 + x_3 * axis_3);
  };
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    add_quad({corner(0, i), corner(0, next), corner(1, next), corner(1, i)}, triangles);
  }
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    add_quad({corner(end, 0), corner(end, 1), corner(end, 2), corner(end, 3)}, triangles);
}

void add_mesh(const structure::Mesh& mesh, std::vector<Triangle>& triangles) {
  const auto vertex = [&](int number) { return mesh.vertices[number]; };
  for (const structure::Shell& shell : mesh.shells) {
    const auto& v = shell.vertices;
    triangles.push_back({vertex(v[0]), vertex(v[1]), vertex(v[2])});
    if (!shell.is_triangle()) triangles.push_back({vertex(v[1]), vertex(v[3]), vertex(v[2])});
  }
  for (const structure::Beam& beam : mesh.beams)
    if (beam.section >= 0) add_bar(mesh, beam, triangles);
  for (const structure::SolidFace& face : structure::outer_faces(mesh)) {
    const auto& of_solid = mesh.solids[face.solid].vertices;
    std::vector<Vector3> corners;
    for (const int corner : face.corners) corners.push_back(vertex(of_solid[corner]));
    add_polygon(corners, triangles);
  }
}

}  // namespace

std::vector<Triangle> surface_of(const BlockModel& block) {
  std::vector<Triangle> triangles;
  if (block.mesh && block.mesh->deck) add_mesh(block.mesh->deck->mesh, triangles);
  for (const PlateModel& plate : block.plates) {
    if (plate.corners)
      add_polygon(plate.corners->value, triangles);
    else if (plate.edges)
      add_ruled(plate.edges->value, triangles);
    else
      add_plates(plate, triangles);
  }
  return triangles;
}

std::vector<Triangle> surface_of(const dynamics::Hull& hull) {
  std::vector<Triangle> triangles;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    std::vector<Vector3> corners;
    for (const int vertex : hull.panel(panel)) corners.push_back(hull.vertex(vertex));
    add_polygon(corners, triangles);
  }
  return triangles;
}

std::vector<Triangle> surface_of(const BoxShape& box) {
  const Eigen::Matrix3d R = rotation_of(box.attitude);
  const auto corner = [&](int x, int y, int z) {
    return Vector3(box.centre + R * (0.5 * Vector3(x, y, z).cwiseProduct(box.size)));
  };
  std::vector<Triangle> triangles;
  for (const int side : {-1, 1}) {
    add_quad({corner(side, -1, -1), corner(side, 1, -1), corner(side, 1, 1), corner(side, -1, 1)},
             triangles);
    add_quad({corner(-1, side, -1), corner(1, side, -1), corner(1, side, 1), corner(-1, side, 1)},
             triangles);
    add_quad({corner(-1, -1, side), corner(1, -1, side), corner(1, 1, side), corner(-1, 1, side)},
             triangles);
  }
  return triangles;
}

std::vector<Triangle> surface_of(const std::vector<BoxShape>& boxes) {
  std::vector<Triangle> triangles;
  for (const BoxShape& box : boxes)
    for (const Triangle& triangle : surface_of(box)) triangles.push_back(triangle);
  return triangles;
}

std::vector<Triangle> surface_of(const given::Load& load) {
  return load.vessel ? surface_of(load.vessel->hull) : surface_of(*load.model);
}

}  // namespace blocklift::pipeline
