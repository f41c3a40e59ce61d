#include "structure/mesh/plates/line_pieces.h"

#include <algorithm>
#include <utility>

namespace blocklift::structure {

void leave_out(double from, double to, LinePieces& line) {
  LinePieces left;
  for (const Interval& part : line) {
    if (part.lower < std::min(part.upper, from))
      left.push_back({part.lower, std::min(part.upper, from)});
    if (std::max(part.lower, to) < part.upper)
      left.push_back({std::max(part.lower, to), part.upper});
  }
  line = std::move(left);
}

}  // namespace blocklift::structure
