#pragma once

#include <vector>

namespace blocklift::dynamics {

/// One gust along the mean wind, the same everywhere: what it adds to the mean speed over time,
/// m/s. With A its magnitude, x = (t - t0)/T the share of its duration T since its start t0:
///
///   one_minus_cosine  A (1 - cos 2 pi x)/2: up to A at half the time, and back,
///   coherent_rise     A (1 - cos pi x)/2, A from then on,
///   operating         -0.37 A sin 3 pi x (1 - cos 2 pi x): down, up to 0.74 A, down, and back,
///
/// and nothing before t0, nor but for the rise after t0 + T.
///
/// Source: IEC 61400-1 (2005), 6.3.2: the extreme operating gust (there T = 10.5 s) and the rise of
/// the extreme coherent gust (T = 10 s, A = 15 m/s), read in public codes; 1 - cosine is the
/// discrete gust of MIL-F-8785C.
class WindGust {
 public:
  enum class Shape { one_minus_cosine, coherent_rise, operating };

  /// @param magnitude A, m/s.
  /// @param start t0, s.
  /// @param duration T, s.
  /// @throws ModelError if a number is not finite, the start negative, or magnitude or duration not
  ///   positive.
  WindGust(Shape shape, double magnitude, double start, double duration);
  /// By a table: straight between its points, constant before the first and behind the last.
  /// @param times ascending, s.
  /// @param speeds that are added, one for each time, m/s.
  /// @throws ModelError if there are fewer than two points or the numbers of both differ, the times
  ///   do not ascend, or a number is not finite.
  WindGust(std::vector<double> times, std::vector<double> speeds);

  /// What is added at a time (s), m/s. Never allocates.
  double evaluate(double time) const;
  /// Times (s) at which an integration looks at the gust, ascending: its corners, or its start, end
  /// and extremes, so that no step goes over it.
  const std::vector<double>& breakpoints() const { return times_; }
  double start() const { return times_.front(); }
  /// Extremes of what is added, m/s: the values at all breakpoints have them.
  double lowest() const;
  double highest() const;

 private:
  Shape shape_ = Shape::one_minus_cosine;
  double magnitude_ = 0.0, duration_ = 0.0;
  std::vector<double> times_;
  std::vector<double> speeds_;  ///< at the times; empty: by the shape
};

}  // namespace blocklift::dynamics
