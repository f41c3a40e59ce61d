#pragma once

#include "dynamics/rope/rope.h"
#include "pipeline/files/rigging/rope_model.h"

namespace blocklift::pipeline {

/// Gives a rope the stiffness or the curve of its model, and the damping time.
void set_stretch(dynamics::RopeDefinition& rope, const RopeModel& model);

}  // namespace blocklift::pipeline
