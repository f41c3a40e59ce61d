#pragma once

#include "pipeline/declaration/diagnostics.h"
#include "structure/mesh/files/deck/deck.h"

namespace blocklift::pipeline {

struct BlockModel;

/// Puts the lugs of a block on the mesh that its deck has: what carries each is found by its node,
/// its set or its pin, and the base of its padeye is looked for on the plates. The pins of lugs
/// that name none are given to the block.
/// Complaints go to the lugs' own lines.
void put_lugs(BlockModel& block, structure::Deck& deck, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
