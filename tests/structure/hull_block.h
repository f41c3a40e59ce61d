#pragma once

#include "structure/mesh/plates/block_description.h"

namespace blocklift::structure::test {

/// Shipbuilding steel AH36.
Material steel();

/// Stiffened hull block of 32 x 20 x 8 m with six lugs on its deck: bottom, tween deck and deck,
/// sides, nine web frames, girders and longitudinal stiffeners, 860 t with outfitting.
BlockDescription hull_block();

/// Open box of 4 x 3 x 2 m with one web frame, a pad and a lug on each of four corners: small
/// enough for unit tests (about 10,000 unknowns with cubic elements).
BlockDescription small_block();

/// Flat plate (z = 0) of 2 x 1 m and 20 mm with an upright one (x = 1 m) of 1 x 1 m and 10 mm
/// through it.
BlockDescription cross_of_plates();

}  // namespace blocklift::structure::test
