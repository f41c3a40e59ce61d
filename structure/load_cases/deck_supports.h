#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/deck/edge_middles.h"
#include "structure/space/space.h"
#include "structure/system/held_sums.h"

namespace blocklift::structure {

/// A direction in which a node is held, and the vertices of the deck that hold it.
struct HeldDirection {
  int node = 0;
  Vector3 axis = Vector3::Zero();  ///< unit
  bool is_rotation = false;
  double value = 0;  ///< m or rad
  /// Vertices with their shares: one where the node is a vertex, else the two ends of its edge.
  std::array<std::pair<int, double>, 2> holders{{{-1, 0}, {-1, 0}}};
};

/// What the supports of a load case hold.
///
/// A deck holds its nodes. Elements of a higher degree have nodes between them: where all that the
/// deck's own element has along an edge, its ends and the middle of a quadratic one, is held along
/// one axis, so is what lies between, as in that element; values are linear or quadratic there. An
/// edge whose own middle is free is held at its ends alone.
/// @param supports the deck's, all of the load case. @param middles the deck's own (own_middles).
std::vector<HeldDirection> find_held_directions(const Space& space,
                                                const std::vector<Support>& supports,
                                                const EdgeMiddles& middles);

/// The same as sums of a space's unknowns. One without coefficients holds what nothing moves.
std::vector<HeldSum> as_sums(const Space& space, const std::vector<HeldDirection>& directions);

}  // namespace blocklift::structure
