#include "pipeline/measurement/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "pipeline/measurement/time_shift.h"

namespace blocklift::pipeline {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void fit_line(const std::vector<double>& measured, const std::vector<double>& computed,
              Agreement& agreement) {
  const double mean_measured = mean_of(measured);
  const double mean_computed = mean_of(computed);
  double both = 0;
  double own = 0;
  double scatter = 0;
  for (std::size_t i = 0; i < computed.size(); ++i) {
    both += (measured[i] - mean_measured) * (computed[i] - mean_computed);
    own += (computed[i] - mean_computed) * (computed[i] - mean_computed);
    scatter += (measured[i] - mean_measured) * (measured[i] - mean_measured);
  }
  if (own <= 1e-18 * static_cast<double>(computed.size()) * mean_computed * mean_computed) return;
  agreement.scale = both / own;
  const double left = std::max(0.0, scatter - both * both / own);
  const double freedom = std::max(1.0, static_cast<double>(computed.size()) - 2);
  agreement.scale_deviation = std::sqrt(left / freedom / own);
  agreement.zero = mean_measured - *agreement.scale * mean_computed;
}

double sum_at(const std::vector<TimeSeries>& series, double instant) {
  double sum = 0;
  for (const TimeSeries& one : series) sum += one.at(instant);
  return sum;
}

}  // namespace

std::optional<Agreement> compare_series(const TimeSeries& measured, const TimeSeries& computed,
                                        const TimeSeries& at_rest, const TimeWindow& window) {
  if (computed.size() < 2) return std::nullopt;
  const TimeWindow common{std::max(window.from, computed.time.front()),
                          std::min(window.to, computed.time.back())};
  const TimeSeries ours = samples_in(measured, common);
  if (ours.size() < 2) return std::nullopt;
  Agreement agreement;
  agreement.samples = ours.size();
  std::vector<double> theirs;
  double squares = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    theirs.push_back(computed.at(ours.time[i]));
    const double difference = ours.values[i] - theirs[i];
    agreement.mean_difference += difference / static_cast<double>(ours.size());
    squares += difference * difference;
    if (i > 0 && std::abs(difference) <= std::abs(agreement.peak_difference)) continue;
    agreement.peak_difference = difference;
    agreement.time_of_peak = ours.time[i];
  }
  agreement.rms_difference = std::sqrt(squares / static_cast<double>(ours.size()));
  agreement.ratio_of_means = mean_of(ours.values) / mean_of(theirs);
  agreement.correlation = correlation_of(ours.values, theirs);
  fit_line(ours.values, theirs, agreement);
  // What was computed where the cell was silent is held against nothing.
  const TimeWindow seen{ours.time.front(), ours.time.back()};
  const std::vector<TimeWindow> gaps = gaps_of(ours);
  const auto largest_in = [&](const TimeSeries& series) {
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < series.size(); ++i)
      if (seen.contains(series.time[i]) && !is_in_gap(gaps, series.time[i]))
        largest = std::fmax(largest, series.values[i]);
    return largest;
  };
  agreement.largest_measured = *std::max_element(ours.values.begin(), ours.values.end());
  agreement.largest_computed = *std::max_element(theirs.begin(), theirs.end());
  if (const double between = largest_in(computed); between > agreement.largest_computed)
    agreement.largest_computed = between;
  agreement.largest_at_rest = largest_in(at_rest);
  return agreement;
}

std::vector<Sharing> find_sharing(const std::vector<TimeSeries>& measured,
                                  const std::vector<TimeSeries>& computed,
                                  const TimeWindow& window) {
  std::vector<Sharing> shares(measured.size());
  if (measured.empty()) return shares;
  std::vector<TimeWindow> gaps;
  for (const TimeSeries& one : measured) {
    const std::vector<TimeWindow> own = gaps_of(one);
    gaps.insert(gaps.end(), own.begin(), own.end());
  }
  const auto is_known = [&](double instant) {
    return window.contains(instant) && !is_in_gap(gaps, instant);
  };
  double largest = 0;
  for (const double instant : measured.front().time)
    if (is_known(instant)) largest = std::max(largest, sum_at(measured, instant));
  double instants = 0;
  for (const double instant : measured.front().time) {
    const double ours = sum_at(measured, instant);
    const double theirs = sum_at(computed, instant);
    if (!is_known(instant) || ours < largest / 10 || ours <= 0 || theirs <= 0) continue;
    ++instants;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      shares[k].measured += measured[k].at(instant) / ours;
      shares[k].computed += computed[k].at(instant) / theirs;
    }
  }
  for (Sharing& share : shares) {
    share.measured /= std::max(1.0, instants);
    share.computed /= std::max(1.0, instants);
  }
  return shares;
}

}  // namespace blocklift::pipeline
