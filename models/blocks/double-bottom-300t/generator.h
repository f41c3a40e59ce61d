#pragma once

#include "structure/mesh/files/deck/deck.h"

namespace blocklift::models {

/// Measures of a block of a ship's double bottom with her side: from the centre line (y = 0) to the
/// side, the inner bottom over the whole breadth, web frames on the side above it. Axes: x along, y
/// to the side, z up from the bottom.
struct DoubleBottomMeasures {
  int cells_per_spacing = 4;  ///< shells between two stiffeners
  double spacing = 0.8;       ///< of longitudinals, m
  int bays = 40;              ///< spacings along the block
  int bays_across = 18;       ///< spacings of flat bottom
  int bays_up = 12;           ///< spacings of side above the inner bottom
  int bays_between_floors = 4;
  int bays_between_girders = 6;
};

/// The block as a deck in mm, t, N with the user's numbers: plates as shells, bulb flats
/// (longitudinals of bottom, inner bottom and side), flat bars on floors and girders and face
/// plates as beams with offsets, manholes of 0.6 m through floors and girders (where 4, 6, 8 ...
/// shells lie between stiffeners), brackets at the feet of the web frames, a stringer, and two
/// pumps on the inner bottom (masses on distributing links). Load cases: none, but for one of
/// gravity.
///
/// The quarter of a circle of the bilge, of two spacings' radius, joins bottom, side and inner
/// bottom.
structure::Deck make_double_bottom(const DoubleBottomMeasures& measures = {});

}  // namespace blocklift::models
