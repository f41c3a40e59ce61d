#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Poses of the spreaders in the world from which their equilibrium is sought, by name: as the case
/// gives them, else as their slings lead: level, under the middle of what these hang from by their
/// mean drop, along the line of what hangs below end a and end b. Tiers follow one another.
///
/// @param place of a point of a hook, crane, vessel or the load at the start, in the world, m.
std::map<std::string, dynamics::Pose> spreader_starts(
    const LiftCase& lift_case, const std::function<Vector3(const ResolvedPoint&)>& place);

}  // namespace blocklift::pipeline
