#pragma once

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics {

/// Heading at which a body is held at rest, as tag lines do: a couple about the plumb stands
/// against what else would turn it, and against nothing else. For a load on one hook, which turns
/// without resistance.
struct HeldHeading {
  BodyIndex body = world_index;        ///< on a free joint to the world
  Matrix3 R_WB = Matrix3::Identity();  ///< at this heading; how it tilts does not matter
};

}  // namespace blocklift::dynamics
