#include "pipeline/measurement/surroundings.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace blocklift::pipeline {
namespace {

constexpr double gust_duration = 3;

/// Integral over time up to each sample, linear between them.
std::vector<double> integral_of(const TimeSeries& series) {
  std::vector<double> integral{0};
  for (std::size_t i = 1; i < series.size(); ++i)
    integral.push_back(integral.back() + (series.time[i] - series.time[i - 1]) *
                                             (series.values[i] + series.values[i - 1]) / 2);
  return integral;
}

double mean_over_time(const TimeSeries& series) {
  return integral_of(series).back() / (series.time.back() - series.time.front());
}

/// Root of the mean square about a value. Squares and not values are taken as linear between
/// samples: chords cut off the crests of waves, of a 4 s wave at 1.28 Hz 12 % of its height.
double deviation_about(const TimeSeries& series, double mean) {
  double sum = 0;
  for (std::size_t i = 1; i < series.size(); ++i) {
    const double a = series.values[i - 1] - mean;
    const double b = series.values[i] - mean;
    sum += (series.time[i] - series.time[i - 1]) * (a * a + b * b) / 2;
  }
  return std::sqrt(sum / (series.time.back() - series.time.front()));
}

}  // namespace

MeasuredWind wind_of(const TimeSeries& speed) {
  MeasuredWind wind;
  wind.mean = mean_over_time(speed);
  wind.deviation = deviation_about(speed, wind.mean);
  const TimeSeries integral{speed.time, integral_of(speed)};
  wind.gust = wind.mean;
  for (const double start : speed.time) {
    if (start + gust_duration > speed.time.back()) break;
    wind.gust = std::max(wind.gust,
                         (integral.at(start + gust_duration) - integral.at(start)) / gust_duration);
  }
  return wind;
}

MeasuredWaves waves_of(const TimeSeries& elevation) {
  MeasuredWaves waves;
  const double mean = mean_over_time(elevation);
  waves.significant_height = 4 * deviation_about(elevation, mean);
  std::vector<double> crossings;
  for (std::size_t i = 1; i < elevation.size(); ++i) {
    const double before = elevation.values[i - 1] - mean;
    const double after = elevation.values[i] - mean;
    if (before < 0 && after >= 0)
      crossings.push_back(elevation.time[i - 1] +
                          (elevation.time[i] - elevation.time[i - 1]) * before / (before - after));
  }
  if (crossings.size() >= 2)
    waves.zero_crossing_period =
        (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  return waves;
}

}  // namespace blocklift::pipeline
