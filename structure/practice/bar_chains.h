#pragma once

#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Edges of shells along which beams run. Along an edge of quadratic shells two beams may run from
/// its ends to a vertex that is fastened between them (SurfacePoint).
std::set<EdgeKey> edges_with_beams(const Mesh& mesh);

/// What meets in the vertices of a mesh.
class MeetingPoints {
 public:
  explicit MeetingPoints(const Mesh& mesh);

  /// Shells, and behind them solids counted on from the number of shells; each once. A vertex that
  /// is fastened to an edge of a shell is a point of all shells that meet there.
  const std::vector<int>& cells(int vertex) const { return cells_[vertex]; }
  const std::vector<int>& beams(int vertex) const { return beams_[vertex]; }
  /// By links, springs and ropes.
  bool is_fastened(int vertex) const { return fastened_.contains(vertex); }
  /// Cells that have both vertices.
  std::vector<int> common_cells(int vertex, int other) const;

 private:
  std::vector<std::vector<int>> cells_, beams_;
  std::set<int> fastened_;
};

/// Piece of a bar: beams one behind the other, each with whether it is passed from its second
/// vertex to its first.
struct BarChain {
  std::vector<std::pair<int, bool>> beams;
  int from = 0, to = 0;  ///< vertices
  double length = 0;     ///< m
};

/// Does a bar go on from one beam into another beyond a vertex that both have?
using BarGoesOn = std::function<bool(int beam, int next, int vertex)>;

/// The pieces into which the given beams fall: a piece ends where it turns from its first beam by
/// more than an angle, where a beam has a release, and where it does not go on.
/// @param most_turn rad.
std::vector<BarChain> find_bar_chains(const Mesh& mesh, const MeetingPoints& points,
                                      const std::vector<int>& beams, double most_turn,
                                      const BarGoesOn& goes_on);

/// From the first vertex of a beam to its second, m.
Vector3 reach_of(const Mesh& mesh, const Beam& beam);

}  // namespace blocklift::structure
