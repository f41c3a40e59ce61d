#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// For cranes that say where from: radius, offlead and sidelead of each hook, and its load over
/// what the load chart allows at that radius. For cranes that say what they stand on: what they
/// press on it, level and in all, and the load of each support.
void add_crane_measures(const LiftCase& lift_case, const LiftRun& lift,
                        std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
