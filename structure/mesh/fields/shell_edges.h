#pragma once

#include <array>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Edges of a shell in the order in which its outline runs round: corners at their ends. One edge
/// of a triangle is a point.
inline constexpr std::array<std::array<int, 2>, 4> round_edges{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};

/// Place of a corner on the unit square.
inline Eigen::Vector2d corner_place(int corner) { return {corner & 1, corner >> 1}; }

/// One side of a shell.
struct EdgeOfShell {
  int shell = 0;
  int edge = 0;  ///< place in round_edges
};

/// Vertices at the ends of an edge, the smaller first.
using EdgeKey = std::pair<int, int>;
/// The sides of shells that lie on each edge.
using EdgeMap = std::map<EdgeKey, std::vector<EdgeOfShell>>;

inline int vertex_of(const Mesh& mesh, int shell, int corner) {
  return mesh.shells[shell].vertices[corner];
}

EdgeKey key_of(const Mesh& mesh, const EdgeOfShell& edge);

/// All edges of a mesh's shells but those that are a point.
EdgeMap collect_edges(const Mesh& mesh);

/// Derivatives of a shell's places by the unit coordinates, m, a column each.
Eigen::Matrix<double, 3, 2> tangents(const Mesh& mesh, int shell, const Eigen::Vector2d& xi);

/// Angle by which the plating turns from one shell into the next across an edge that they share, in
/// the middle of the edge, rad: 0 where it goes on smoothly, pi where it turns back. Which sides
/// the shells' normals are on does not matter.
double kink_between(const Mesh& mesh, const EdgeOfShell& a, const EdgeOfShell& b);

/// Kink from which on plating has a corner, rad: an octagon is still round.
inline constexpr double corner_kink = 46 * std::numbers::pi / 180;

/// Which shells are facets of curved plating: those that meet another one at a kink that is neither
/// nothing nor a corner of the structure (corner_kink).
std::vector<bool> find_facets(const Mesh& mesh);

}  // namespace blocklift::structure
