#pragma once

#include <cstddef>

#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// When the condition of a stage comes about, s: the operation is integrated up to it, with what
/// the model's schedule knows of earlier stages.
/// @throws dynamics::SimulationError if it does not in the stage's time, or the integration fails.
double find_stage_end(const LiftCase& lift_case, const BuiltLift& model, std::size_t stage,
                      const Progress& progress);

/// How the drives go whose courses are not known yet, in the order of the schedule: the operation
/// is integrated as far as all but those is known (Schedule::last_known_stage).
/// @throws dynamics::SimulationError if the integration fails.
std::vector<dynamics::Course> find_courses(const LiftCase& lift_case, const BuiltLift& model,
                                           const Progress& progress);

}  // namespace blocklift::pipeline
