#include "structure/mesh/fields/shell_edges.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace blocklift::structure {

namespace {

Vector3 normal_at(const Mesh& mesh, int shell, const Eigen::Vector2d& xi) {
  const Eigen::Matrix<double, 3, 2> g = tangents(mesh, shell, xi);
  return Vector3(g.col(0)).cross(Vector3(g.col(1))).normalized();
}

/// Unit vector across an edge into its shell. The normal is that in the edge's middle, since curved
/// shells are smooth where they meet and not in their middles.
Vector3 into_shell(const Mesh& mesh, const EdgeOfShell& edge) {
  const auto& ends = round_edges[edge.edge];
  const Eigen::Vector2d on_edge = 0.5 * (corner_place(ends[0]) + corner_place(ends[1]));
  const Vector3 normal =
      normal_at(mesh, edge.shell, on_edge + 0.01 * (Eigen::Vector2d(0.5, 0.5) - on_edge));
  const Vector3 along = mesh.vertices[vertex_of(mesh, edge.shell, ends[1])] -
                        mesh.vertices[vertex_of(mesh, edge.shell, ends[0])];
  return normal.cross(along).normalized();
}

}  // namespace

EdgeKey key_of(const Mesh& mesh, const EdgeOfShell& edge) {
  return std::minmax(vertex_of(mesh, edge.shell, round_edges[edge.edge][0]),
                     vertex_of(mesh, edge.shell, round_edges[edge.edge][1]));
}

EdgeMap collect_edges(const Mesh& mesh) {
  EdgeMap edges;
  for (int shell = 0; shell < static_cast<int>(mesh.shells.size()); ++shell)
    for (int edge = 0; edge < 4; ++edge) {
      const EdgeKey key = key_of(mesh, {shell, edge});
      if (key.first != key.second) edges[key].push_back({shell, edge});
    }
  return edges;
}

Eigen::Matrix<double, 3, 2> tangents(const Mesh& mesh, int shell, const Eigen::Vector2d& xi) {
  const Shell& s = mesh.shells[shell];
  Eigen::Matrix<double, 3, 2> g;
  if (s.curvature < 0) {
    const auto v = [&](std::size_t i) { return mesh.vertices[s.vertices[i]]; };
    g.col(0) = (1 - xi.y()) * (v(1) - v(0)) + xi.y() * (v(3) - v(2));
    g.col(1) = (1 - xi.x()) * (v(2) - v(0)) + xi.x() * (v(3) - v(1));
    return g;
  }
  const double step = 1e-4;
  for (int a = 0; a < 2; ++a) {
    const Eigen::Vector2d along = step * Eigen::Vector2d::Unit(a);
    g.col(a) = (position(mesh, s, xi + along) - position(mesh, s, xi - along)) / (2 * step);
  }
  return g;
}

double kink_between(const Mesh& mesh, const EdgeOfShell& a, const EdgeOfShell& b) {
  const Vector3 into_a = into_shell(mesh, a), into_b = into_shell(mesh, b);
  return std::atan2(into_a.cross(into_b).norm(), -into_a.dot(into_b));
}

std::vector<bool> find_facets(const Mesh& mesh) {
  constexpr double smooth = 0.01;  // rad
  std::vector<bool> is_facet(mesh.shells.size(), false);
  for (const auto& [key, sides] : collect_edges(mesh))
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        const double kink = kink_between(mesh, sides[i], sides[j]);
        if (kink > smooth && kink < corner_kink)
          is_facet[sides[i].shell] = is_facet[sides[j].shell] = true;
      }
  return is_facet;
}

}  // namespace blocklift::structure
