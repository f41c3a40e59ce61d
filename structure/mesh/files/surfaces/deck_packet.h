#pragma once

#include "structure/mesh/files/deck/deck.h"
#include "structure/packet.h"

namespace blocklift::structure {

/// Puts what a file of surfaces gives into a packet: vertices, shells, beams, points on shells,
/// regions, groups, sets, ledger and remarks; nothing else of a deck.
void put_surfaces(const Deck& deck, Packet& packet);

/// Takes them in the same order.
Deck take_surfaces(Packet& packet);

}  // namespace blocklift::structure
