#pragma once

#include "structure/elasticity/part_model.h"
#include "structure/system/natural_modes.h"

namespace blocklift::structure {

/// Modes of a part that its supports hold (at zero displacement); without supports, of the free
/// part, whose first six are rigid; unknown 3 n + a is node n along axis a.
/// @throws ModelError as find_natural_modes, or if an element is inverted.
NaturalModes find_part_modes(const PartModel& model, int count);

}  // namespace blocklift::structure
