#pragma once

#include <string>
#include <vector>

#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

/// What a deck says of a solid beside its nodes.
struct GivenSolid {
  std::string card;  ///< or keyword, for messages
  SourceLine line;
  bool tells_middles = false;  ///< of its edges, or some of them
};

/// Gives the solids of a deck the middles of their edges. Those that are numbered inside out, so
/// that their volume is negative, are turned, and a remark says so: loads and surfaces name faces
/// by the nodes, or by the numbers, that the deck gives. Complains of each solid whose Jacobian is
/// not positive at its nodes, centre and points of integration, and of each that has a face
/// turned by a quarter against the opposite one, as where the nodes of one begin elsewhere; and of
/// edges in whose middle one solid has a node of its own and the next another.
/// @param given one a solid of the mesh
void complete_solids(Deck& deck, const std::vector<GivenSolid>& given, DeckLog& log);

}  // namespace blocklift::structure
