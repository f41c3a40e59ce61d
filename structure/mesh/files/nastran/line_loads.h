#pragma once

#include <vector>

#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

/// Shares of a bar's length, between its ends, at which a PLOAD1 wants the bar divided: where it
/// acts at a place, begins or ends, and, where it is not even, between. Elements then have the
/// exact moments, or those of a linear load to some thousandths.
/// @param length of the line that the bar's offsets lead to, in the deck's units.
/// @throws CardError as line_loads does for the card alone.
std::vector<double> divisions_by_line_load(const CardView& card, double length);

/// The loads that a PLOAD1 puts on a CBAR or CBEAM, one or several for each of its pieces.
///
/// It acts along the line that the bar's offsets lead to, which is a CBEAM's line of shear centres;
/// X counts along this line, and the element's axes are about it. A projected load (LEPR, FRPR) of
/// a basic direction is per length of the line as seen along that direction.
/// Source: MSC Nastran Quick Reference Guide and Altair OptiStruct Reference Guide, PLOAD1.
/// @param first place of the bar's first piece in the mesh.
/// @throws CardError for fields that are no PLOAD1, and places beyond the bar.
std::vector<BeamLoad> line_loads(const NastranModel& model, const CardView& card, int first);

}  // namespace blocklift::structure
