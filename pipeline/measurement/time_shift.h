#pragma once

#include <optional>
#include <vector>

#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// One quantity as it was measured, by the clock of the record, and as it was computed.
struct ChannelPair {
  TimeSeries measured;
  TimeSeries computed;
};

/// What puts a record on the clock of the computed lift.
struct TimeShift {
  double shift = 0;        ///< s, to be added to the record's instants
  double correlation = 0;  ///< mean over the channels at that shift, 1 at most
  /// The largest correlation at a shift that is not the neighbourhood of the best one; none where
  /// the correlation falls to all sides.
  std::optional<double> runner_up;

  /// Whether the alignment is to be doubted: a poor correlation, or another shift as good.
  bool is_doubtful() const {
    return correlation < 0.7 || (runner_up && *runner_up > correlation - 0.02);
  }
};

/// Finds the shift at which the channels' correlation coefficients (Pearson), their mean over all
/// channels, are largest. They ask neither for the zero nor for the scale of a transducer. Shifts
/// are tried that leave half of the shorter of record and lift in common; the best is refined
/// below the time between samples. Among shifts that are equally good the longer common time wins.
/// @returns none where no channel moves, so that nothing can be aligned.
std::optional<TimeShift> find_time_shift(const std::vector<ChannelPair>& channels);

/// Pearson's correlation coefficient of two rows of equal length; 0 where one is constant.
double correlation_of(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace blocklift::pipeline
