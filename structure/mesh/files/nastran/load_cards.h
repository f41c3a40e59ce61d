#pragma once

#include "structure/mesh/files/deck/deck.h"
#include "structure/mesh/files/nastran/card_writer.h"

namespace blocklift::structure {

/// Writes what acts on all masses: GRAV and RFORCE of a load set of the deck. An axis beside the
/// origin is one through it and the acceleration of its place.
void write_loads_of_masses(const LoadSet& set, long label, const UnitSystem& units,
                           CardWriter& out);

}  // namespace blocklift::structure
