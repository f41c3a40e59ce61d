#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/files/deck/deck.h"
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
/// A deck holds its nodes. Elements of a higher degree have nodes between them: where both ends of
/// an edge are held along one axis, so is what lies between, as in the deck's own elements; values
/// are linear there.
/// @param supports the deck's, all of the load case.
std::vector<HeldDirection> find_held_directions(const Space& space,
                                                const std::vector<Support>& supports);

/// The same as sums of a space's unknowns. One without coefficients holds what nothing moves.
std::vector<HeldSum> as_sums(const Space& space, const std::vector<HeldDirection>& directions);

}  // namespace blocklift::structure
