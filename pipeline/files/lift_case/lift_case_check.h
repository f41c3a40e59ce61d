#pragma once

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Complains about what does not fit together in a case whose models have been read: cranes, ropes
/// and operation against load table, start values, names, the operation itself. Parts that could
/// not be read are passed over.
void check_lift_case(const LiftCase& lift_case, Diagnostics& diagnostics);

/// Complains about cranes of a case without other mistakes whose loops are open where the case
/// starts their drives.
void check_loops_at_start(const LiftCase& lift_case, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
