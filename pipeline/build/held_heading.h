#pragma once

#include <optional>
#include <vector>

#include "dynamics/rope/rope.h"
#include "dynamics/simulation/equilibrium.h"
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

/// How the equilibria of a lift are sought, its heading held where that is to be. The rooms above
/// have solver and settings from here alone (check_rooms.py), so that none forgets the heading: the
/// load would turn at rest.
dynamics::EquilibriumSettings settings_at_rest(const BuiltLift& model);
/// The model must outlive the solver.
dynamics::EquilibriumSolver solver_at_rest(const BuiltLift& model);

}  // namespace blocklift::pipeline
