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

/// What puts a record on the clock of the computed lift: instant + shift + rate (instant - middle).
struct TimeShift {
  double shift = 0;        ///< s, to be added to the record's instants
  double correlation = 0;  ///< mean over the channels at that shift, 1 at most
  /// The largest correlation at a shift that is not the neighbourhood of the best one; none where
  /// the correlation falls to all sides.
  std::optional<double> runner_up = {};
  double rate = 0;    ///< by which the record's clock is slow: 1e-3 loses a second in 1,000 s
  double middle = 0;  ///< instant of the record that is later by the shift alone, s

  /// Whether the alignment is to be doubted: a poor correlation, or another shift as good.
  bool is_doubtful() const {
    return correlation < 0.7 || (runner_up && *runner_up > correlation - 0.02);
  }
};

/// Finds the shift at which the channels' correlation coefficients (Pearson), their mean over all
/// channels, are largest. They ask neither for the zero nor for the scale of a transducer. Shifts
/// are tried that leave half of the shorter of record and lift in common; the best is refined
/// below the time between samples. Among shifts that are equally good the longer common time wins.
/// What lies in gaps (gaps_of) counts nowhere. Where the record's first and last third lie best at
/// shifts of their own, and a clock that is slow or fast by 1 % at most halves what the correlation
/// lacks of one, the clock has that rate.
/// @returns none where no channel moves, so that nothing can be aligned.
std::optional<TimeShift> find_time_shift(const std::vector<ChannelPair>& channels);

/// A series by the clock of the lift.
TimeSeries on_clock(TimeSeries series, const TimeShift& clock);

/// Pearson's correlation coefficient of two rows of equal length; 0 where one is constant.
double correlation_of(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace blocklift::pipeline
