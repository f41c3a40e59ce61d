#pragma once

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Complains about an operation that cannot be: conditions of stages and what operators keep by
/// drives and ropes that are not there, faults, its duration. Comes after all other checks: its
/// duration is looked at where nothing else was wrong.
void check_operation(const LiftCase& lift_case, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
