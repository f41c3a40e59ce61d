#pragma once

#include <vector>

#include "structure/mesh/plates/sheets.h"

namespace blocklift::structure {

/// Cross-section of a stiffener without its plate.
struct StiffenerFigures {
  double area = 0;           ///< m^2
  double second_moment = 0;  ///< about the middle plane of its plate, for bending away from it, m^4
};

/// Of a web from the plate's middle plane to its far edge, and a flange: what the shells have.
StiffenerFigures figures_as_plates(const StiffenerPlates& plates, double plate_thickness);

/// Of a profile that stands on the plate's face with its origin: what its beam has.
StiffenerFigures figures_as_beam(const Profile& profile, double plate_thickness);

/// Makes sheets of the lines of those rows of stiffeners that are plates, and takes the lines from
/// the sheets of plates on which they stand.
///
/// A web runs from its plate's middle plane to the middle plane of the flange, or to the top of a
/// flat bar; it keeps the profile's height over the plate's face, on pads too. It ends at openings
/// of its plate (a third of their shorter side before those that are no rectangles), and where
/// another plate stands in its place. Sheets whose middle planes would lie within one another's
/// thickness lie in one plane: the stiffener moves.
/// @param sheets of plates, with their openings.
void make_stiffener_sheets(const BlockDescription& block, std::vector<Sheet>& sheets);

}  // namespace blocklift::structure
