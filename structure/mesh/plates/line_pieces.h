#pragma once

#include <vector>

#include "structure/mesh/plates/block_description.h"

namespace blocklift::structure {

/// Parts of a line, apart from one another, in order, m.
using LinePieces = std::vector<Interval>;

/// Leaves out what lies between two places.
void leave_out(double from, double to, LinePieces& line);

}  // namespace blocklift::structure
