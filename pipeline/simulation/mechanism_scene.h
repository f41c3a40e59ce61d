#pragma once

#include "pipeline/build/build_mechanism.h"
#include "pipeline/results/files/result_file.h"

namespace blocklift::pipeline {

/// How a mechanism is drawn: bodies by their shapes; one without shapes by bars from its origin to
/// its centre of mass and to whatever is fixed to it: joints, loops, springs, ropes.
Scene make_scene(const MechanismFile& file, const BuiltMechanism& mechanism);

}  // namespace blocklift::pipeline
