#pragma once

#include <string>
#include <vector>

#include "structure/mesh/plates/block_description.h"
#include "structure/mesh/plates/free_plates.h"
#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

/// A free plate, a web or flange on one, a pad on one, or a lug on such a pad.
struct FreeSheet {
  std::string name;
  SheetRank rank = SheetRank::plate;
  double thickness = 0;          ///< m
  std::string material;          ///< its own, or that of what it lies on
  std::vector<Vector3> corners;  ///< m; empty: a plate between two edges
  int base = -1;                 ///< of a pad its plate, of a lug its pad: places among free sheets
  int row = -1;                  ///< of a web or flange: place in BlockDescription::free_stiffeners
};

/// Free plates, then webs and flanges of their stiffeners that are plates, then free pads, then
/// free lugs, each in the order of the block. Webs end as beams do; their ends are upright.
/// @throws ModelError naming plates without area or not in one plane, pads on plates that are not
///   there or are not plane, lugs on pads that are not there, rectangles without size, rows of
///   stiffeners as free_stiffener_lines does.
std::vector<FreeSheet> spread_free_sheets(const BlockDescription& block);

/// The lines of the rows of stiffeners on free plates that are beams, from edge to edge, cut by
/// openings; where a pad is thicker, they stand on that. Sections and regions of the patterns are
/// the row's place.
/// @throws ModelError naming rows on plates that are not there or are not plane.
std::vector<BeamLine> free_stiffener_lines(const BlockDescription& block);

}  // namespace blocklift::structure
