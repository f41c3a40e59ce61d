#pragma once

#include <optional>
#include <vector>

#include "dynamics/rope/rope.h"
#include "pipeline/build/build_lift.h"

namespace blocklift::pipeline {

/// The heading of a load that nothing but the air turns: all ropes that hold it hang on one hook,
/// no tugger pulls at it, it does not float, and the hook turns freely: it has a bearing, keeps its
/// direction, or has all that hangs on it in one place. None: something else turns it or holds it.
/// @param definitions of all ropes of the lift, by LiftRope::rope.
/// @param drawn the load and how the case has it.
std::optional<dynamics::HeldHeading> find_held_heading(
    const LiftCase& lift_case, const std::vector<LiftRope>& ropes,
    const std::vector<LiftHoist>& hoists, const std::vector<dynamics::RopeDefinition>& definitions,
    const dynamics::HeldHeading& drawn);

}  // namespace blocklift::pipeline
