#pragma once

#include <optional>

#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// Wind as an anemometer saw it, m/s.
struct MeasuredWind {
  double mean = 0;
  double deviation = 0;  ///< standard deviation of the samples
  double gust = 0;       ///< largest mean over 3 s
};

/// Waves as a record of the surface's height shows them.
struct MeasuredWaves {
  double significant_height = 0;  ///< four standard deviations, m
  /// Mean time between crossings of the mean upwards, s; none for less than two.
  std::optional<double> zero_crossing_period;
};

/// Both need at least two samples, which a record has; means are over time.
MeasuredWind wind_of(const TimeSeries& speed);
MeasuredWaves waves_of(const TimeSeries& elevation);

}  // namespace blocklift::pipeline
