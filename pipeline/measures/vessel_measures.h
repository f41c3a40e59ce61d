#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Heel, trim and freeboard of the case's vessels, which a load that is lost lets go.
void add_vessel_measures(const LiftCase& lift_case, const LiftRun& lift,
                         std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
