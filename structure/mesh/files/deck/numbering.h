#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// The user's own numbers as far as they are given and each is one; new ones beyond the greatest
/// for the rest.
class Numbering {
 public:
  explicit Numbering(const std::vector<long>& wanted = {}) {
    for (const long number : wanted) raise(number);
  }
  /// Makes sure that new numbers lie beyond this one.
  void raise(long number) { greatest_ = number > greatest_ ? number : greatest_; }
  long take(long wanted) {
    if (wanted > 0 && taken_.insert(wanted).second) return wanted;
    while (!taken_.insert(++greatest_).second) {
    }
    return greatest_;
  }

 private:
  std::unordered_set<long> taken_;
  long greatest_ = 0;
};

/// All numbers of a mesh's cells, links, masses and springs.
std::vector<long> element_labels(const Mesh& mesh);

/// Axes that each vertex' supports, links and springs count along; identity where there are none.
/// @throws ModelError naming a vertex where two differ: a deck has one system of axes at a node.
std::vector<Eigen::Matrix3d> vertex_axes(const Deck& deck);

/// Vertices that are the middles of a curved shell's edges, in the order around it; where the mesh
/// has none there, they are added to it.
class MiddleVertices {
 public:
  explicit MiddleVertices(Mesh& mesh);
  std::vector<int> of(const Shell& shell);

 private:
  int at_place(const Vector3& place);

  Mesh& mesh_;
  double step_ = 1;
  std::unordered_multimap<long, int> cells_;
};

}  // namespace blocklift::structure
