#include "structure/mesh/shell_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace blocklift::structure {

namespace {

/// Slopes at x of the Lagrange polynomials through `count` equally spaced points of [0, 1].
Eigen::VectorXd lagrange_slopes(int count, double x) {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(count);
  for (int i = 0; i < count; ++i)
    for (int left_out = 0; left_out < count; ++left_out) {
      if (left_out == i) continue;
      double product = static_cast<double>(count - 1) / (i - left_out);
      for (int j = 0; j < count; ++j)
        if (j != i && j != left_out) product *= (x * (count - 1) - j) / (i - j);
      slopes[i] += product;
    }
  return slopes;
}

/// Normals, as long as the surface is large there, at the corners of a quadrangle.
std::vector<Vector3> normals_at_corners(const Mesh& mesh, const Shell& shell) {
  const auto vertex = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[shell.vertices[i]];
  };
  const Vector3 low = vertex(1) - vertex(0), high = vertex(3) - vertex(2),
                left = vertex(2) - vertex(0), right = vertex(3) - vertex(1);
  return {low.cross(left), low.cross(right), high.cross(left), high.cross(right)};
}

std::vector<Vector3> normals_of_curved(const Mesh& mesh, const Shell& shell) {
  // Corners, middles, and Gauss' points of three by three.
  static const std::array<double, 5> places{0, 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15),
                                            1};
  const auto points = static_cast<double>(mesh.curved_shells[shell.curvature].cols());
  const int count = static_cast<int>(std::lround(std::sqrt(points)));
  std::vector<Vector3> normals;
  for (const double eta : places) {
    if (shell.is_triangle() && eta == 1) continue;  // that side is a point
    const Eigen::VectorXd slopes_eta = lagrange_slopes(count, eta);
    for (const double xi : places) {
      const Eigen::VectorXd slopes_xi = lagrange_slopes(count, xi);
      Vector3 along_xi = Vector3::Zero(), along_eta = Vector3::Zero();
      for (int i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / (count - 1);
        along_xi += slopes_xi[i] * position(mesh, shell, {share, eta});
        along_eta += slopes_eta[i] * position(mesh, shell, {xi, share});
      }
      normals.emplace_back(along_xi.cross(along_eta));
    }
  }
  return normals;
}

/// How far the edges of a triangle rise over the plane of its corners, in thicknesses.
double rise_of_triangle(const Mesh& mesh, const Shell& shell) {
  std::array<Vector3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[shell.vertices[i]];
  const Vector3 normal =
      (corners[1] - corners[0]).cross(Vector3(corners[2] - corners[0])).normalized();
  double rise = 0;
  for (const Eigen::Vector2d& middle :
       {Eigen::Vector2d(0.5, 0), Eigen::Vector2d(0, 0.5), Eigen::Vector2d(1, 0.5)})
    rise = std::max(rise, std::abs(normal.dot(position(mesh, shell, middle) - corners[0])));
  return rise / thickness_at(mesh, shell, {0.5, 0.5});
}

}  // namespace

bool is_folded(const Mesh& mesh, const Shell& shell) {
  const bool is_curved = shell.curvature >= 0;
  if (!is_curved && shell.is_triangle()) return false;
  const std::vector<Vector3> normals =
      is_curved ? normals_of_curved(mesh, shell) : normals_at_corners(mesh, shell);
  Vector3 sum = Vector3::Zero();
  double largest = 0;
  for (const Vector3& normal : normals) {
    sum += normal;
    largest = std::max(largest, normal.norm());
  }
  const double size = longest_edge(mesh, shell);
  if (!(largest > 1e-8 * size * size)) return false;
  // The corners of a symmetric bow tie cancel one another.
  if (!(sum.norm() > 1e-6 * largest)) return true;
  // Coordinates of decks have four digits and more: three corners in line are not quite so.
  constexpr double rounding = 1e-3;
  const Vector3 mean = sum.normalized();
  return std::any_of(normals.begin(), normals.end(),
                     [&](const Vector3& normal) { return normal.dot(mean) < -rounding * largest; });
}

std::vector<int> fastened_off_straight_shells(const Mesh& mesh) {
  constexpr double rounding = 1e-6;  // of the shell's size
  std::vector<int> off;
  for (const SurfacePoint& point : mesh.surface_points) {
    Shell straight = mesh.shells[point.shell];
    if (straight.curvature < 0 || !point.line.empty()) continue;
    straight.curvature = -1;
    const double distance =
        (mesh.vertices[point.vertex] - position(mesh, straight, point.xi)).norm();
    if (distance > rounding * longest_edge(mesh, straight)) off.push_back(point.vertex);
  }
  return off;
}

std::vector<int> find_locking_triangles(const Mesh& mesh, int degree) {
  std::vector<std::pair<double, int>> found;
  if (degree < 2 || degree > 3) return {};
  constexpr double limit = 1;
  for (std::size_t s = 0; s < mesh.shells.size(); ++s) {
    const Shell& shell = mesh.shells[s];
    if (!shell.is_triangle() || shell.curvature < 0) continue;
    if (const double rise = rise_of_triangle(mesh, shell); rise > limit)
      found.emplace_back(-rise, static_cast<int>(s));
  }
  std::sort(found.begin(), found.end());
  std::vector<int> triangles;
  for (const auto& [rise, shell] : found) triangles.push_back(shell);
  return triangles;
}

}  // namespace blocklift::structure
