#pragma once

#include <cstddef>
#include <vector>

namespace blocklift::pipeline {

/// Values over time; both lists have one length, and time rises.
struct TimeSeries {
  std::vector<double> time;  ///< s
  std::vector<double> values;

  std::size_t size() const { return time.size(); }
  /// The value at an instant, linear between samples; the first or last one beyond them.
  /// The series must not be empty.
  double at(double instant) const;
};

/// A stretch of time, s.
struct TimeWindow {
  double from = 0;
  double to = 0;

  bool contains(double instant) const { return instant >= from && instant <= to; }
  double length() const { return to - from; }
};

/// Where a series says nothing: between samples that follow each other ten times as far apart as
/// half of them do at most. What lies between is not known.
std::vector<TimeWindow> gaps_of(const TimeSeries& series);

/// Does an instant lie within one of the gaps? Their ends, where samples are, do not.
bool is_in_gap(const std::vector<TimeWindow>& gaps, double instant);

/// The samples whose instants lie in a window.
TimeSeries samples_in(const TimeSeries& series, const TimeWindow& window);

/// A series on another clock: all instants later by `shift`.
TimeSeries shifted(TimeSeries series, double shift);

}  // namespace blocklift::pipeline
