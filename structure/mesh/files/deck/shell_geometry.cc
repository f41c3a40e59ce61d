#include "structure/mesh/files/deck/shell_geometry.h"

#include <Eigen/Geometry>

#include "structure/index.h"

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

Vector3 unit_normal(const Mesh& mesh, const Shell& shell) {
  const auto vertex = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[at(shell.vertices[i])];
  };
  return (vertex(3) - vertex(0)).cross(vertex(2) - vertex(1)).normalized();
}

}  // namespace blocklift::structure
