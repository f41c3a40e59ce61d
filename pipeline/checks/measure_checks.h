#pragma once

#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Measures of the lift against the limits of its case and its cranes: tilt, sling angles, leads,
/// clearances; hooks against their load charts, and loads of supports, which lift off where they
/// press no more; spreaders against buckling. Of each kind that has one limit for all the worst is
/// shown.
std::vector<Check> check_measures(const LiftCase& lift_case, const LiftRun& lift,
                                  const std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
