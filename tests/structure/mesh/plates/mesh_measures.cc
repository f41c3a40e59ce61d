#include "tests/structure/mesh/plates/mesh_measures.h"

#include <algorithm>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "structure/index.h"

namespace blocklift::structure::testing {

namespace {

using Edge = std::pair<int, int>;

std::array<Edge, 4> edges_of(const Shell& shell) {
  const auto& v = shell.vertices;
  return {std::minmax(v[0], v[1]), std::minmax(v[2], v[3]), std::minmax(v[0], v[2]),
          std::minmax(v[1], v[3])};
}

double length_of(const Mesh& mesh, const Edge& edge) {
  return (mesh.vertices[at(edge.second)] - mesh.vertices[at(edge.first)]).norm();
}

std::map<Edge, std::vector<int>> shells_of_edges(const Mesh& mesh) {
  std::map<Edge, std::vector<int>> shells;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s)
    for (const Edge& edge : edges_of(mesh.shells[s])) shells[edge].push_back(static_cast<int>(s));
  return shells;
}

}  // namespace

SteelMeasures measure(const Mesh& mesh) {
  SteelMeasures steel;
  const auto vertex = [&](int v) { return mesh.vertices[at(v)]; };
  for (const Shell& shell : mesh.shells) {
    const auto& v = shell.vertices;
    // The two triangles of a flat quadrangle.
    for (const std::size_t corner : {std::size_t{0}, std::size_t{3}}) {
      const Vector3 a = vertex(v[corner]), b = vertex(v[1]), c = vertex(v[2]);
      const double area = 0.5 * (b - a).cross(c - a).norm();
      const double mass = area * mesh.section_of(shell).thickness * mesh.material_of(shell).density;
      steel.area += area;
      steel.area_of_region[mesh.regions[at(shell.region)].name] += area;
      steel.area_of_group[mesh.group_of_region(shell.region).name] += area;
      steel.mass += mass;
      steel.centre += mass * (a + b + c) / 3;
    }
  }
  for (const Beam& beam : mesh.beams) {
    const Vector3 a = vertex(beam.vertices[0]) + beam.offset[0];
    const Vector3 b = vertex(beam.vertices[1]) + beam.offset[1];
    const BeamSection& section = mesh.section_of(beam);
    const double mass =
        (b - a).norm() * section.area * mesh.materials[at(section.material)].density;
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
    for (const int s : shells) regions.insert(mesh.shells[at(s)].region);
    if (shells.size() > 2 || regions.size() > 1) length += length_of(mesh, edge);
  }
  return length;
}

void expect_conforming(const Mesh& mesh) {
  const auto edges = shells_of_edges(mesh);
  for (const auto& [edge, shells] : edges) {
    std::map<int, int> of_region;
    for (const int s : shells) ++of_region[mesh.shells[at(s)].region];
    for (const auto& [region, count] : of_region)
      EXPECT_LE(count, 2) << mesh.regions[at(region)].name;
    const Vector3 a = mesh.vertices[at(edge.first)], b = mesh.vertices[at(edge.second)];
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (static_cast<int>(v) == edge.first || static_cast<int>(v) == edge.second) continue;
      const Vector3& p = mesh.vertices[v];
      EXPECT_GT((p - a).norm() + (p - b).norm(), (b - a).norm() + 1e-9)
          << "vertex " << v << " lies on an edge, at " << p.transpose();
    }
  }
  std::map<int, Vector3> normal_of_region;
  for (const Shell& shell : mesh.shells) {
    const auto vertex = [&](std::size_t i) { return mesh.vertices[at(shell.vertices[i])]; };
    const Vector3 normal = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).normalized();
    const auto [known, is_new] = normal_of_region.try_emplace(shell.region, normal);
    EXPECT_LT((known->second - normal).norm(), 1e-9);
    if (!is_new) continue;
    EXPECT_GT(normal.sum(), 0) << "normals point along the axes";
  }
  for (const Beam& beam : mesh.beams)
    EXPECT_EQ(edges.count(std::minmax(beam.vertices[0], beam.vertices[1])), 1U)
        << "beam " << beam.label << " lies on no shell's edge";
}

}  // namespace blocklift::structure::testing
