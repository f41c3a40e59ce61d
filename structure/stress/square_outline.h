#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Dense>

#include "structure/formulation/shell.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/stress/squares.h"

namespace blocklift::structure::square_outline {

/// Gauss points on [0, 1].
inline constexpr std::array<double, 4> side_points{0.06943184420297371, 0.33000947820757187,
                                                   0.6699905217924281, 0.9305681557970263};
inline constexpr std::array<double, 4> side_weights{0.17392742256872693, 0.32607257743127307,
                                                    0.32607257743127307, 0.17392742256872693};

/// A point of the outline with what multiplies the motion there: weight times the outward normal.
struct ContourPoint {
  Vector3 place;
  Eigen::Vector2d normal;  ///< in e_1, e_2, times the length that the point stands for
};

inline std::array<ContourPoint, 16> contour(const Square& square) {
  std::array<ContourPoint, 16> points;
  const double half = square.size / 2;
  for (std::size_t i = 0; i < 4; ++i) {
    const double s = square.size * side_points[i] - half, w = square.size * side_weights[i];
    points[i] = {square.centre_B + s * square.e_1 - half * square.e_2, {0, -w}};
    points[4 + i] = {square.centre_B + s * square.e_1 + half * square.e_2, {0, w}};
    points[8 + i] = {square.centre_B - half * square.e_1 + s * square.e_2, {-w, 0}};
    points[12 + i] = {square.centre_B + half * square.e_1 + s * square.e_2, {w, 0}};
  }
  return points;
}

/// Where the way to the points of a square begins, when it is placed and when it is evaluated:
/// another way may end elsewhere.
inline ShellPlace start_of(const Square& square) { return {square.shell, {0.5, 0.5}}; }

/// Of a shell's surface, of length one.
inline Vector3 normal_of(const Mesh& mesh, const ShellPlace& place) {
  const auto normal_at = [&](const Eigen::Vector2d& xi) -> Vector3 {
    const Eigen::Matrix<double, 3, 2> g = tangents(mesh, place.shell, xi);
    return Vector3(g.col(0)).cross(Vector3(g.col(1)));
  };
  const Eigen::Vector2d middle(0.5, 0.5);
  // A triangle has none in the corner that is an edge of its unit square.
  const bool has_none = normal_at(place.xi).norm() < 1e-3 * normal_at(middle).norm();
  return normal_at(has_none ? place.xi + 0.01 * (middle - place.xi) : place.xi).normalized();
}

}  // namespace blocklift::structure::square_outline
