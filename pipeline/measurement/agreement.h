#pragma once

#include <optional>
#include <vector>

#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// How a measured quantity lies beside the computed one, on one clock; differences are measured
/// less computed, in the quantity's unit.
struct Agreement {
  std::size_t samples = 0;  ///< of the record in the common time
  double mean_difference = 0;
  double rms_difference = 0;
  double peak_difference = 0;  ///< the one of the largest size, with its sign
  double time_of_peak = 0;     ///< s of the lift
  double correlation = 0;      ///< Pearson's coefficient
  /// The line measured = zero + scale computed of least squares; none where nothing moves.
  std::optional<double> scale;
  double scale_deviation = 0;  ///< standard deviation of the scale, for independent errors
  double zero = 0;
  double largest_measured = 0;
  double largest_computed = 0;
  double largest_at_rest = 0;  ///< of the static history; NaN where there is none
  /// Mean measured over mean computed: 1.05 of a load that is 5 % heavier than was thought.
  double ratio_of_means = 0;

  /// The dynamic amplification factor as computed: largest in motion over largest at rest.
  double computed_amplification() const { return largest_computed / largest_at_rest; }
  /// The same of the measurement. What is at rest is not measured: it is the computed one, made as
  /// much larger as the mean was measured to be, so that an error of the weight is no dynamics.
  double measured_amplification() const {
    return largest_measured / (ratio_of_means * largest_at_rest);
  }
};

/// Compares at the record's instants that lie in the window; the computed values are linear between
/// their samples. The largest ones are those outside the record's gaps (gaps_of).
/// @param measured already on the clock of the lift.
/// @returns none for less than two instants in common.
std::optional<Agreement> compare_series(const TimeSeries& measured, const TimeSeries& computed,
                                        const TimeSeries& at_rest, const TimeWindow& window);

/// What share of the sum several ropes have on average.
struct Sharing {
  double measured = 0;
  double computed = 0;
};

/// Mean shares of each rope in the sum of all, over the instants in the window at which the
/// measured sum is at least a tenth of its largest and no rope has a gap.
/// @param measured of each rope, on the clock of the lift; the instants are those of the first.
std::vector<Sharing> find_sharing(const std::vector<TimeSeries>& measured,
                                  const std::vector<TimeSeries>& computed,
                                  const TimeWindow& window);

}  // namespace blocklift::pipeline
