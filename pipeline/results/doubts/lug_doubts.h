#pragma once

#include <string>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// A sentence about a lug at which two ropes or more end while another lug of the load has none, as
/// a line that was copied and not changed makes it. Empty if there is no such lug, or none without
/// a rope. Ropes that begin at lugs and are led on, over a hook or to another lug, count at both
/// ends.
std::string doubt_about_lugs(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
