#pragma once

#include <vector>

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::structure {

/// Fastens the middles of quadratic shells' edges that beams, links, masses, springs, supports,
/// loads or corners of other shells use: each becomes a surface point of the first shell that has
/// it. The deck keeps all of them as its shell_middles.
/// @param middles of all quadratic shells, in the order of shells
void fasten_used_middles(Deck& deck, const std::vector<SurfacePoint>& middles);

}  // namespace blocklift::structure
