// Curved triangles, whose membrane strains lock, are found where they do.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "structure/mesh/shell_shape.h"

namespace blocklift::structure {
namespace {

/// Adds a triangle over a chart, curved of an order, with its corners at places of the chart.
void add_curved_triangle(Mesh& mesh, const examples::Chart& chart, int order,
                         const Eigen::Matrix<double, 2, 3>& corners) {
  const auto vertex = [&](int i) {
    return examples::vertex_at(mesh, chart(corners(0, i), corners(1, i)));
  };
  Shell shell;
  shell.vertices = {vertex(0), vertex(1), vertex(2), vertex(2)};
  shell.label = static_cast<long>(mesh.shells.size()) + 1;
  shell.curvature = static_cast<int>(mesh.curved_shells.size());
  Eigen::Matrix3Xd points(3, (order + 1) * (order + 1));
  for (int j = 0; j <= order; ++j)
    for (int i = 0; i <= order; ++i) {
      const double xi = static_cast<double>(i) / order, eta = static_cast<double>(j) / order;
      const Eigen::Vector2d place =
          corners * Eigen::Vector3d((1 - eta) * (1 - xi), (1 - eta) * xi, eta);
      points.col(j * (order + 1) + i) = chart(place.x(), place.y());
    }
  // As decks have it: a surface of the six nodes alone.
  if (order == 2)
    points.col(4) = -0.125 * (points.col(0) + points.col(2)) + 0.25 * points.col(1) +
                    0.5 * (points.col(3) + points.col(5));
  mesh.curved_shells.push_back(points);
  mesh.shells.push_back(shell);
}

/// A quarter of a ring, radius 1 m and thickness 20 mm, in pairs of triangles.
Mesh quarter_of_triangles(int pairs, int order) {
  Material material = examples::plain_steel();
  material.poisson_ratio = 0;
  Mesh mesh = examples::empty_mesh(material, 0.02);
  const auto chart = [](double x, double y) -> Vector3 {
    return {std::cos(std::numbers::pi / 2 * x), 0.2 * y, std::sin(std::numbers::pi / 2 * x)};
  };
  for (int i = 0; i < pairs; ++i) {
    const double left = static_cast<double>(i) / pairs, right = (i + 1.0) / pairs;
    Eigen::Matrix<double, 2, 3> lower, upper;
    lower << left, right, right, 0, 0, 1;
    upper << right, left, left, 1, 1, 0;
    add_curved_triangle(mesh, chart, order, lower);
    add_curved_triangle(mesh, chart, order, upper);
  }
  return mesh;
}

/// By how much the ring gives way to two opposite forces, a share of
/// P R^3 / (E I) (pi / 8 - 1 / pi) (Timoshenko 1955).
double flexibility_share(const Mesh& mesh, int degree) {
  const Space space(mesh, {degree, {}});
  const auto is_on_plane = [](int component) {
    return [=](const Vector3& place) { return std::abs(place[component]) < 1e-6; };
  };
  std::vector<FixedUnknown> fixed;
  examples::hold(space, is_on_plane(0), {0, 4, 5}, fixed);
  examples::hold(space, is_on_plane(2), {2, 3, 4}, fixed);
  examples::hold(space, is_on_plane(1), {1}, fixed);
  const double force = 1000, width = 0.2, inertia = width * std::pow(0.02, 3) / 12;
  const Eigen::VectorXd motion =
      examples::solve(space,
                      examples::edge_load(space, is_on_plane(0),
                                          [&](const Vector3&) -> Vector3 {
                                            return {0, 0, -force / 2 / width};
                                          }),
                      fixed);
  return -examples::displacement_at(space, motion, {0, 0.1, 1}).z() /
         (force / (210e9 * inertia) * (std::numbers::pi / 8 - 1 / std::numbers::pi));
}

// The least share that is not told of is 0.98, the largest that is 0.75, both of degree 3.
TEST(CurvedTriangles, ThoseThatLockAreFound) {
  for (const int degree : {2, 3, 4})
    for (const int pairs : {2, 4, 8, 16}) {
      const Mesh mesh = quarter_of_triangles(pairs, degree);
      const double share = flexibility_share(mesh, degree);
      const std::vector<int> found = find_locking_triangles(mesh, degree);
      EXPECT_EQ(share < 0.95, !found.empty())
          << "degree " << degree << ", " << pairs << " pairs: " << share;
      EXPECT_TRUE(found.empty() || found.size() == mesh.shells.size());
    }
}

// A flat triangle with curved edges rises over nothing.
TEST(CurvedTriangles, CurvedEdgesInAPlaneAreNone) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.02);
  Eigen::Matrix<double, 2, 3> corners;
  corners << 0, 1, 0, 0, 0, 1;
  add_curved_triangle(
      mesh,
      [](double x, double y) -> Vector3 {
        return {x, y + 0.2 * x * (1 - x), 0};
      },
      2, corners);
  EXPECT_TRUE(find_locking_triangles(mesh, 2).empty());
}

}  // namespace
}  // namespace blocklift::structure
