#pragma once

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// What the case chooses of its standard exists there, and what the standard needs is given: by the
/// case, and by the models of its slings.
void check_standard(const LiftCase& lift_case, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline
