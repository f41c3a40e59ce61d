#pragma once

#include <functional>

#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// The fault of a case that comes at its worst instant; null: none does.
const given::Fault* fault_at_worst(const LiftCase& lift_case);

/// Seeks the instant at which that fault is worst: after which one of the ropes that it names
/// carries the most of its breaking load.
///
/// Tried are instants (samples) at which drives move: forty even ones and those at which a motion's
/// jerk jumps, where ramps begin and end; then eight between the neighbours of each of the three
/// worst, four times as close, and so on until they are a sample or a twentieth of a second apart.
/// Each trial goes on from where the undisturbed lift is at that instant, and is watched for the
/// fault's `watched`. The largest of what is tried is found, which need not be the largest of all:
/// a load bounces on its ropes while it is hoisted, and where in a bounce the fault comes matters.
///
/// Where the surface of the water is marched beside, each trial runs from the start.
///
/// @param build the lift with the fault at that instant (s); none: without it.
/// @throws dynamics::SimulationError if a run fails, or nothing moves while the instant is sought.
WorstInstant find_worst_instant(
    const LiftCase& lift_case, const std::function<BuiltLift(std::optional<double> instant)>& build,
    const Progress& progress);

}  // namespace blocklift::pipeline
