#include "pipeline/measurement/time_series.h"

#include <algorithm>
#include <utility>

#include "algebra/quantile.h"

namespace blocklift::pipeline {

double TimeSeries::at(double instant) const {
  if (instant <= time.front()) return values.front();
  if (instant >= time.back()) return values.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), instant) - time.begin());
  const double share = (instant - time[next - 1]) / (time[next] - time[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
}

std::vector<TimeWindow> gaps_of(const TimeSeries& series) {
  constexpr double wide = 10;
  std::vector<TimeWindow> gaps;
  if (series.size() < 3) return gaps;
  std::vector<double> steps;
  for (std::size_t i = 1; i < series.size(); ++i)
    steps.push_back(series.time[i] - series.time[i - 1]);
  const double usual = algebra::quantile_of(std::move(steps), 0.5);
  for (std::size_t i = 1; i < series.size(); ++i)
    if (series.time[i] - series.time[i - 1] > wide * usual)
      gaps.push_back({series.time[i - 1], series.time[i]});
  return gaps;
}

bool is_in_gap(const std::vector<TimeWindow>& gaps, double instant) {
  return std::any_of(gaps.begin(), gaps.end(),
                     [&](const TimeWindow& gap) { return instant > gap.from && instant < gap.to; });
}

TimeSeries samples_in(const TimeSeries& series, const TimeWindow& window) {
  TimeSeries samples;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!window.contains(series.time[i])) continue;
    samples.time.push_back(series.time[i]);
    samples.values.push_back(series.values[i]);
  }
  return samples;
}

TimeSeries shifted(TimeSeries series, double shift) {
  for (double& instant : series.time) instant += shift;
  return series;
}

}  // namespace blocklift::pipeline
