#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// By how much what drives keep is missed, while they keep it.
void add_keeping_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
