#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Tensions of tuggers, and of moorings at their fairleads.
void add_line_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures);
/// Shares of the two ends of ropes with friction at their sheaves.
void add_sheave_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
