#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Points of a quadratic shell on the unit square, 3 x 9, xi fastest, from its corners and the
/// middles of its edges, both around it as Nastran and Abaqus number them: corners 1 .. 4 (3 for a
/// triangle), the middle i between corners i and i + 1.
///
/// The inner points follow from the eight-node serendipity or the six-node triangular
/// interpolation; the triangle's last corner fills one side of the square.
Eigen::Matrix3Xd quadratic_points(const std::vector<Vector3>& corners,
                                  const std::vector<Vector3>& middles);

/// Where the middle i of a quadratic shell lies on the unit square.
Eigen::Vector2d place_of_middle(std::size_t corners, std::size_t i);

/// Vertices in the order of Shell::vertices from those around a quadrangle or triangle.
std::array<int, 4> lexicographic(const std::vector<int>& around);
/// The same of what they have.
std::array<double, 4> lexicographic(const std::vector<double>& around);

/// Unit normal of a shell in its middle.
Vector3 unit_normal(const Mesh& mesh, const Shell& shell);

/// Shells by the edges between their vertices, the lower vertex first.
using ShellsByEdge = std::multimap<std::pair<int, int>, int>;
std::pair<int, int> edge_between(int vertex, int other);

/// The halves of curved edges, on whose middle a vertex lies (SurfacePoint), are edges, too, of all
/// shells that meet there.
ShellsByEdge shells_by_edge(const Mesh& mesh);

}  // namespace blocklift::structure
