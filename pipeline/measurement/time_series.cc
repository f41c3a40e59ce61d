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

namespace {

/// Windows of two lists, in order; those that meet become one.
std::vector<TimeWindow> in_one_list(std::vector<TimeWindow> windows,
                                    const std::vector<TimeWindow>& others) {
  windows.insert(windows.end(), others.begin(), others.end());
  std::sort(windows.begin(), windows.end(),
            [](const TimeWindow& a, const TimeWindow& b) { return a.from < b.from; });
  std::vector<TimeWindow> apart;
  for (const TimeWindow& window : windows) {
    if (apart.empty() || window.from >= apart.back().to)
      apart.push_back(window);
    else
      apart.back().to = std::max(apart.back().to, window.to);
  }
  return apart;
}

}  // namespace

std::vector<TimeWindow> gaps_of(const TimeSeries& series) {
  constexpr double wide = 10;
  std::vector<TimeWindow> gaps;
  if (series.size() < 3) return series.left_out;
  std::vector<double> steps;
  for (std::size_t i = 1; i < series.size(); ++i)
    steps.push_back(series.time[i] - series.time[i - 1]);
  const double usual = algebra::quantile_of(std::move(steps), 0.5);
  for (std::size_t i = 1; i < series.size(); ++i)
    if (series.time[i] - series.time[i - 1] > wide * usual)
      gaps.push_back({series.time[i - 1], series.time[i]});
  return in_one_list(std::move(gaps), series.left_out);
}

bool is_in_gap(const std::vector<TimeWindow>& gaps, double instant) {
  return std::any_of(gaps.begin(), gaps.end(),
                     [&](const TimeWindow& gap) { return instant > gap.from && instant < gap.to; });
}

double known_share(const TimeSeries& series, const TimeWindow& window) {
  if (series.size() == 0 || !(window.length() > 0)) return 0;
  const auto within = [&](double from, double to) {
    return std::max(0.0, std::min(to, window.to) - std::max(from, window.from));
  };
  double known = within(series.time.front(), series.time.back());
  for (const TimeWindow& gap : gaps_of(series)) known -= within(gap.from, gap.to);
  return std::clamp(known / window.length(), 0.0, 1.0);
}

TimeSeries samples_in(const TimeSeries& series, const TimeWindow& window) {
  TimeSeries samples{{}, {}, series.left_out};
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!window.contains(series.time[i])) continue;
    samples.time.push_back(series.time[i]);
    samples.values.push_back(series.values[i]);
  }
  return samples;
}

TimeSeries shifted(TimeSeries series, double shift) {
  for (double& instant : series.time) instant += shift;
  for (TimeWindow& window : series.left_out) window = {window.from + shift, window.to + shift};
  return series;
}

}  // namespace blocklift::pipeline
