#pragma once

#include "pipeline/build/build_marine.h"
#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// What of a lift floats, in its place: vessels with the cranes that stand on them, and the load if
/// it is lowered into the water. The case must outlive the builder.
MarineBuilder marine_of(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
