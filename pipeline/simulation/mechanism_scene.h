#pragma once

#include "pipeline/assessment/result_file.h"
#include "pipeline/input/build_mechanism.h"

namespace blocklift::pipeline {

/// How a mechanism is drawn: bodies by their shapes; one without shapes by bars from its origin to its centre
/// of mass and to whatever is fixed to it: joints, loops, springs, ropes.
Scene make_scene(const MechanismFile& file, const BuiltMechanism& mechanism);

}  // namespace blocklift::pipeline
