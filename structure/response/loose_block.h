#pragma once

#include <string>
#include <utility>

#include "structure/error.h"
#include "structure/rigid_body.h"

namespace blocklift::structure {

/// A part of a block can move against the rest, and nothing resists.
class LooseBlock : public ModelError {
 public:
  LooseBlock(const std::string& message, Vector3 the_place, int the_freedom)
      : ModelError(message), place(std::move(the_place)), freedom(the_freedom) {}
  Vector3 place;  ///< of one of the nodes that move, in the block's frame, m
  int freedom;  ///< what it does there: displacement along x, y, z, rotation about x, y, z (0 to 5)
};

}  // namespace blocklift::structure
