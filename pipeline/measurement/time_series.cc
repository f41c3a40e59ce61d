#include "pipeline/measurement/time_series.h"

#include <algorithm>

namespace blocklift::pipeline {

double TimeSeries::at(double instant) const {
  if (instant <= time.front()) return values.front();
  if (instant >= time.back()) return values.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), instant) - time.begin());
  const double share = (instant - time[next - 1]) / (time[next] - time[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
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
