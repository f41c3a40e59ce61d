#pragma once

#include <string>
#include <vector>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// What a lift engineer would ask about before believing the figures of a run that went through: a
/// load in the ground or far from where it was put, ropes beyond their breaking loads, cranes in
/// one place, wind that finds nothing to blow on, values that hardly any lift has. Each a sentence
/// that says what was found, and for values what is usual.
std::vector<std::string> list_doubts(const LiftCase& lift_case, const LiftRun& lift);
/// Those that need no run: cranes, wind, values.
std::vector<std::string> list_doubts(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
