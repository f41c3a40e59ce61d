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
};

/// The samples whose instants lie in a window.
TimeSeries samples_in(const TimeSeries& series, const TimeWindow& window);

/// A series on another clock: all instants later by `shift`.
TimeSeries shifted(TimeSeries series, double shift);

}  // namespace blocklift::pipeline
