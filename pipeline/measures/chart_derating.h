#pragma once

#include <string>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// What is left of a crane's load charts in the wind and the sea of a lift.
struct ChartFactor {
  double value = 1;  ///< of wind times that of the sea; zero beyond the maker's tables
  std::string
      text;  ///< "x 0.8 for wind of 12 m/s (source)"; empty where the crane declares nothing
};

/// By the tables that the crane's model declares. The wind is the mean speed of the case, nought
/// without wind; the sea its significant height, 4 sqrt(m0) of regular waves and of records, and
/// nought in calm water. A case without a sea is ashore, where the table of the sea does not count.
ChartFactor find_chart_factor(const CraneModel& crane, const LiftCase& lift_case);

}  // namespace blocklift::pipeline
