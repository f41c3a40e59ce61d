#include "tests/structure/mesh/plates/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace blocklift::structure::test {

namespace {

using Edge = std::pair<int, int>;

std::array<Edge, 4> edges_of(const Shell& shell) {
  const auto& v = shell.vertices;
  return {std::minmax(v[0], v[1]), std::minmax(v[2], v[3]), std::minmax(v[0], v[2]),
          std::minmax(v[1], v[3])};
}

double length_of(const Mesh& mesh, const Edge& edge) {
  return (mesh.vertices[edge.second] - mesh.vertices[edge.first]).norm();
}

std::map<Edge, std::vector<int>> shells_of_edges(const Mesh& mesh) {
  std::map<Edge, std::vector<int>> shells;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s)
    for (const Edge& edge : edges_of(mesh.shells[s])) shells[edge].push_back(static_cast<int>(s));
  return shells;
}

/// Gauss' three points a direction: visit(place, normal, area). Tangents are differences of
/// polynomials of third degree over a small step: exact to the square of it.
template <typename Visit>
void for_each_point(const Mesh& mesh, const Shell& shell, const Visit& visit) {
  const double points[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18}, step = 1e-4;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d xi(points[i], points[j]);
      const auto tangent = [&](const Eigen::Vector2d& way) -> Vector3 {
        return (position(mesh, shell, xi + step * way) - position(mesh, shell, xi - step * way)) /
               (2 * step);
      };
      const Vector3 normal =
          tangent(Eigen::Vector2d::UnitX()).cross(tangent(Eigen::Vector2d::UnitY()));
      visit(position(mesh, shell, xi), normal.normalized(),
            weights[i] * weights[j] * normal.norm());
    }
}

}  // namespace

SteelMeasures measure(const Mesh& mesh) {
  SteelMeasures steel;
  for (const Shell& shell : mesh.shells) {
    const double per_area = mesh.section_of(shell).thickness * mesh.material_of(shell).density;
    for_each_point(mesh, shell, [&](const Vector3& place, const Vector3&, double area) {
      steel.area += area;
      steel.area_of_region[mesh.regions[shell.region].name] += area;
      steel.area_of_group[mesh.group_of_region(shell.region).name] += area;
      steel.mass += area * per_area;
      steel.centre += area * per_area * place;
    });
  }
  for (const Beam& beam : mesh.beams) {
    const Vector3 a = mesh.vertices[beam.vertices[0]] + beam.offset[0];
    const Vector3 b = mesh.vertices[beam.vertices[1]] + beam.offset[1];
    const BeamSection& section = mesh.section_of(beam);
    const double mass = (b - a).norm() * section.area * mesh.materials[section.material].density;
    steel.mass += mass;
    steel.centre += mass * (a + b) / 2;
  }
  steel.centre /= steel.mass;
  return steel;
}

double joint_length(const Mesh& mesh) {
  double length = 0;
  for (const auto& [edge, shells] : shells_of_edges(mesh)) {
    std::set<int> regions;
    for (const int s : shells) regions.insert(mesh.shells[s].region);
    if (shells.size() > 2 || regions.size() > 1) length += length_of(mesh, edge);
  }
  return length;
}

double joint_overlap(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [edge, shells] : shells_of_edges(mesh)) {
    std::array<int, 3> count{};
    std::array<double, 3> thickness{};  // sum over the shells normal to each axis
    for (const int s : shells) {
      const Shell& shell = mesh.shells[s];
      const auto vertex = [&](std::size_t i) { return mesh.vertices[shell.vertices[i]]; };
      Eigen::Index normal = 0;
      (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).maxCoeff(&normal);
      ++count[normal];
      thickness[normal] += mesh.section_of(shell).thickness;
    }
    double square = length_of(mesh, edge);
    int covered = 0, planes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (count[axis] == 0) continue;
      square *= thickness[axis] / count[axis];
      covered += count[axis];
      ++planes;
    }
    if (planes == 2) volume += square * (covered - 2) / 2;
  }
  return volume;
}

void expect_conforming(const Mesh& mesh) {
  const auto edges = shells_of_edges(mesh);
  for (const auto& [edge, shells] : edges) {
    std::map<int, int> of_region;
    for (const int s : shells) ++of_region[mesh.shells[s].region];
    for (const auto& [region, count] : of_region) EXPECT_LE(count, 2) << mesh.regions[region].name;
    const Vector3 a = mesh.vertices[edge.first], b = mesh.vertices[edge.second];
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (static_cast<int>(v) == edge.first || static_cast<int>(v) == edge.second) continue;
      const Vector3& p = mesh.vertices[v];
      EXPECT_GT((p - a).norm() + (p - b).norm(), (b - a).norm() + 1e-9)
          << "vertex " << v << " lies on an edge, at " << p.transpose();
    }
  }
  std::map<int, Vector3> normal_of_region;
  for (const Shell& shell : mesh.shells) {
    for_each_point(mesh, shell, [&](const Vector3&, const Vector3& normal, double area) {
      EXPECT_GT(area, 0);
      const auto [known, is_new] = normal_of_region.try_emplace(shell.region, normal);
      EXPECT_LT((known->second - normal).norm(), 1e-6) << "shell " << shell.label;
      if (is_new) {
        EXPECT_GT(normal.sum(), 0) << "normals point along the axes";
      }
    });
  }
  for (const Beam& beam : mesh.beams)
    EXPECT_EQ(edges.count(std::minmax(beam.vertices[0], beam.vertices[1])), 1U)
        << "beam " << beam.label << " lies on no shell's edge";
}

}  // namespace blocklift::structure::test
