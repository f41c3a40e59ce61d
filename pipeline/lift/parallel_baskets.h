#pragma once

#include <string>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Why a load that hangs in baskets alone, whose edges all run the same way, slides along them: a
/// basket over smooth edges lies where its path is shortest, and follows the load along them
/// without resistance. Empty where a lug, a basket across, the ground or water may hold the load.
std::string doubt_about_baskets(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
