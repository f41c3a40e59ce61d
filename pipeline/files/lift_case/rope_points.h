#pragma once

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Looks up the ends and sheaves of the case's ropes, the edges that they may touch, and what
/// operators keep, and complains about names that do not exist.
void resolve_points(LiftCase& lift_case, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
