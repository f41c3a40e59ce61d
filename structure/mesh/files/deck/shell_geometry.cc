#include "structure/mesh/files/deck/shell_geometry.h"

#include <Eigen/Geometry>

namespace blocklift::structure {

Eigen::Matrix3Xd quadratic_points(const std::vector<Vector3>& corners,
                                  const std::vector<Vector3>& middles) {
  Eigen::Matrix3Xd points(3, 9);
  if (corners.size() == 4) {
    Vector3 centre = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i) centre += 0.5 * middles[i] - 0.25 * corners[i];
    points << corners[0], middles[0], corners[1], middles[3], centre, middles[1], corners[3],
        middles[2], corners[2];
    return points;
  }
  // Barycentric (1/4, 1/4, 1/2): corners L (2 L - 1), middles 4 L L.
  const Vector3 centre =
      -0.125 * (corners[0] + corners[1]) + 0.25 * middles[0] + 0.5 * (middles[1] + middles[2]);
  points << corners[0], middles[0], corners[1], middles[2], centre, middles[1], corners[2],
      corners[2], corners[2];
  return points;
}

Eigen::Vector2d place_of_middle(std::size_t corners, std::size_t i) {
  static const std::array<Eigen::Vector2d, 4> of_quadrangle{
      Eigen::Vector2d(0.5, 0), Eigen::Vector2d(1, 0.5), Eigen::Vector2d(0.5, 1),
      Eigen::Vector2d(0, 0.5)};
  static const std::array<Eigen::Vector2d, 3> of_triangle{
      Eigen::Vector2d(0.5, 0), Eigen::Vector2d(1, 0.5), Eigen::Vector2d(0, 0.5)};
  return corners == 4 ? of_quadrangle[i] : of_triangle[i];
}

std::array<int, 4> lexicographic(const std::vector<int>& around) {
  if (around.size() == 3) return {around[0], around[1], around[2], around[2]};
  return {around[0], around[1], around[3], around[2]};
}

std::array<double, 4> lexicographic(const std::vector<double>& around) {
  if (around.size() == 3) return {around[0], around[1], around[2], around[2]};
  return {around[0], around[1], around[3], around[2]};
}

Vector3 unit_normal(const Mesh& mesh, const Shell& shell) {
  const auto vertex = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[shell.vertices[i]];
  };
  return (vertex(3) - vertex(0)).cross(vertex(2) - vertex(1)).normalized();
}

std::pair<int, int> edge_between(int vertex, int other) { return std::minmax(vertex, other); }

ShellsByEdge shells_by_edge(const Mesh& mesh) {
  ShellsByEdge shells;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const auto& v = mesh.shells[s].vertices;
    for (const auto& [from, to] : {edge_between(v[0], v[1]), edge_between(v[1], v[3]),
                                   edge_between(v[3], v[2]), edge_between(v[2], v[0])})
      if (from != to) shells.emplace(std::pair(from, to), static_cast<int>(s));
  }
  ShellsByEdge halves;
  for (const SurfacePoint& point : mesh.surface_points) {
    const auto& v = mesh.shells[point.shell].vertices;
    // Corners of the side on which the point lies; within a shell it lies on none.
    std::array<int, 2> ends{-1, -1};
    if (point.xi[0] == 0) ends = {v[0], v[2]};
    if (point.xi[0] == 1) ends = {v[1], v[3]};
    if (point.xi[1] == 0) ends = {v[0], v[1]};
    if (point.xi[1] == 1) ends = {v[2], v[3]};
    if (ends[0] == ends[1]) continue;
    const auto [first, last] = shells.equal_range(edge_between(ends[0], ends[1]));
    for (auto it = first; it != last; ++it)
      for (const int end : ends) halves.emplace(edge_between(end, point.vertex), it->second);
  }
  shells.merge(halves);
  return shells;
}

}  // namespace blocklift::structure
