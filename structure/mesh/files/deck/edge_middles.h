#pragma once

#include <map>
#include <utility>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Vertices in the middle of edges of plates and solids, by the edge's ends, the smaller first.
using EdgeMiddles = std::map<std::pair<int, int>, int>;

/// Those that are nodes of the deck's file: of its quadratic elements.
EdgeMiddles own_middles(const Deck& deck);

/// The deck with supports at the middles of solids' edges that its reader made, where a set holds
/// both ends along the same axes: in a file they are nodes, which stay free unless they are held.
Deck with_held_middles(const Deck& deck);

}  // namespace blocklift::structure
