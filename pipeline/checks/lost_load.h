#pragma once

#include <optional>

#include "pipeline/checks/checks.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// A load that no rope holds any more must stand or float: nine tenths of its weight must be borne
/// when the last of its ropes parts, else it falls. Ropes hold it at once, or by way of hook blocks
/// and spreaders; one that has not parted is enough, however slack.
/// @returns none where a rope holds the load to the end.
std::optional<Check> check_held(const LiftCase& lift_case, const LiftRun& lift);

}  // namespace blocklift::pipeline
