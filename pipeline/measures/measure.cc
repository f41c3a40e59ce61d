#include "pipeline/measures/measure.h"

#include <cmath>
#include <limits>

#include "pipeline/measures/clearance.h"
#include "pipeline/measures/crane_measures.h"
#include "pipeline/measures/edge_measures.h"
#include "pipeline/measures/hook_block_measures.h"
#include "pipeline/measures/keeping_measures.h"
#include "pipeline/measures/line_measures.h"
#include "pipeline/measures/load_measures.h"
#include "pipeline/measures/spreader_measures.h"
#include "pipeline/measures/tackle_measures.h"
#include "pipeline/measures/vessel_measures.h"

namespace blocklift::pipeline {

namespace {

/// How far out a value is: the more, the further.
double rank(double value, Extreme extreme) {
  switch (extreme) {
    case Extreme::largest:
      return value;
    case Extreme::smallest:
      return -value;
    case Extreme::largest_magnitude:
      break;
  }
  return std::abs(value);
}

}  // namespace

MeasurePeak find_peak(const Eigen::VectorXd& time, const Eigen::VectorXd& values, Extreme extreme) {
  MeasurePeak peak{std::numeric_limits<double>::quiet_NaN(), 0};
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (std::isnan(peak.value) || rank(values[i], extreme) > rank(peak.value, extreme))
      peak = {values[i], time[i]};
  }
  return peak;
}

MeasurePeak find_peak(const LiftRun& lift, const LiftMeasure& measure) {
  const MeasurePeak still = find_peak(lift.static_history.time, measure.at_rest, measure.extreme);
  const MeasurePeak moving =
      find_peak(lift.dynamic_history().time, measure.in_motion, measure.extreme);
  if (std::isnan(still.value)) return moving;
  if (std::isnan(moving.value)) return still;
  return rank(moving.value, measure.extreme) > rank(still.value, measure.extreme) ? moving : still;
}

std::vector<LiftMeasure> find_measures(const LiftCase& lift_case, const LiftRun& lift) {
  std::vector<LiftMeasure> measures;
  add_load_measures(lift_case, lift, measures);
  add_spreader_measures(lift_case, lift, measures);
  add_crane_measures(lift_case, lift, measures);
  add_hook_block_measures(lift, measures);
  add_vessel_measures(lift_case, lift, measures);
  add_keeping_measures(lift, measures);
  add_tackle_measures(lift_case, lift, measures);
  add_line_measures(lift, measures);
  add_sheave_measures(lift, measures);
  add_edge_measures(lift, measures);
  add_clearances(lift_case, lift, measures);
  return measures;
}

}  // namespace blocklift::pipeline
