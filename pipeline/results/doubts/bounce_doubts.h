#pragma once

#include <string>
#include <vector>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// What may be wrong with the motions in which the load swings on its stretched ropes: ropes that
/// damp more than any do. Each a sentence with what was found and what is usual. Nothing where no
/// natural modes are known, nor of a load that rests on pads at times.
std::vector<std::string> list_bounce_doubts(const LiftCase& lift_case, const LiftRun& lift);

}  // namespace blocklift::pipeline
