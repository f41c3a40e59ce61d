#pragma once

#include <ostream>

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// What one wants to know where an integration fails, of the workspace's instant: slack ropes and
/// those that carry most, the fastest bodies, and loops that are near a toggle.
/// @throws ModelError or SimulationError where the loops cannot be judged.
void describe_motion(std::ostream& text, const LiftSystem& system, const LiftWorkspace& w);

}  // namespace blocklift::dynamics
