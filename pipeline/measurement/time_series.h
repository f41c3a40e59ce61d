#pragma once

#include <cstddef>
#include <vector>

namespace blocklift::pipeline {

/// A stretch of time, s.
struct TimeWindow {
  double from = 0;
  double to = 0;

  bool contains(double instant) const { return instant >= from && instant <= to; }
  double length() const { return to - from; }
};

/// Values over time; both lists have one length, and time rises.
struct TimeSeries {
  std::vector<double> time;  ///< s
  std::vector<double> values;
  /// Between which samples others were left out, in order and apart: what lies within is not known.
  std::vector<TimeWindow> left_out = {};

  std::size_t size() const { return time.size(); }
  /// The value at an instant, linear between samples; the first or last one beyond them.
  /// The series must not be empty.
  double at(double instant) const;
};

/// Where a series says nothing: between samples that follow each other ten times as far apart as
/// half of them do at most, and where samples were left out. What lies between is not known.
/// In order and apart.
std::vector<TimeWindow> gaps_of(const TimeSeries& series);

/// Does an instant lie within one of the gaps? Their ends, where samples are, do not.
bool is_in_gap(const std::vector<TimeWindow>& gaps, double instant);

/// Which share of a window a series knows: neither before it nor behind it, nor within its gaps.
double known_share(const TimeSeries& series, const TimeWindow& window);

/// The samples whose instants lie in a window.
TimeSeries samples_in(const TimeSeries& series, const TimeWindow& window);

/// A series on another clock: all instants later by `shift`.
TimeSeries shifted(TimeSeries series, double shift);

}  // namespace blocklift::pipeline
