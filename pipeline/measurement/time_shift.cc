#include "pipeline/measurement/time_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blocklift::pipeline {
namespace {

/// Most samples of the coarse search, and the loss of correlation that losing the whole common time
/// is worth to it.
constexpr double coarse_samples = 2000;
constexpr double loss_of_overlap = 0.05;

/// A series at equal steps from an instant on.
struct EvenSeries {
  double start = 0;
  std::vector<double> values;
};

/// @param span that all rows have in common; a series that begins later or ends earlier rests
/// there.
EvenSeries evenly_sampled(const TimeSeries& series, const TimeWindow& span, double step) {
  EvenSeries even{span.from, {}};
  const auto count = static_cast<std::size_t>(std::floor((span.to - span.from) / step)) + 1;
  for (std::size_t i = 0; i < count; ++i)
    even.values.push_back(series.at(even.start + static_cast<double>(i) * step));
  return even;
}

/// From the first instant of all series to their last.
TimeWindow span_of(const std::vector<ChannelPair>& channels, TimeSeries ChannelPair::*which) {
  TimeWindow span{(channels.front().*which).time.front(), (channels.front().*which).time.back()};
  for (const ChannelPair& channel : channels) {
    span.from = std::min(span.from, (channel.*which).time.front());
    span.to = std::max(span.to, (channel.*which).time.back());
  }
  return span;
}

double mean_step(const TimeSeries& series) {
  return (series.time.back() - series.time.front()) / static_cast<double>(series.size() - 1);
}

bool moves(const TimeSeries& series) {
  if (series.size() < 2) return false;
  const auto [least, most] = std::minmax_element(series.values.begin(), series.values.end());
  return *most - *least > 1e-9 * std::max(std::abs(*least), std::abs(*most));
}

/// Pearson's coefficient of the samples [begin, end) of one row and those `lag` later in the other.
double correlation_at_lag(const std::vector<double>& measured, const std::vector<double>& computed,
                          long lag, long begin, long end) {
  double sum_a = 0;
  double sum_b = 0;
  for (long i = begin; i < end; ++i) {
    sum_a += measured[i];
    sum_b += computed[i + lag];
  }
  const double mean_a = sum_a / static_cast<double>(end - begin);
  const double mean_b = sum_b / static_cast<double>(end - begin);
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (long i = begin; i < end; ++i) {
    const double a = measured[i] - mean_a;
    const double b = computed[i + lag] - mean_b;
    aa += a * a;
    bb += b * b;
    ab += a * b;
  }
  const double size = static_cast<double>(end - begin);
  const double smallest = 1e-18 * size * (mean_a * mean_a + mean_b * mean_b);
  if (aa <= smallest * mean_a * mean_a || bb <= smallest * mean_b * mean_b) return 0;
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

struct Score {
  double correlation = 0;
  double worth = -std::numeric_limits<double>::infinity();  ///< with the common time
};

/// All lags that leave half of the shorter row in common.
struct CoarseSearch {
  std::vector<EvenSeries> measured, computed;
  double step = 0;
  long first_lag = 0;
  std::vector<Score> scores;

  void run() {
    const auto m = static_cast<long>(measured.front().values.size());
    const auto c = static_cast<long>(computed.front().values.size());
    const long least = std::max(4L, std::min(m, c) / 2);
    first_lag = least - m;
    for (long lag = first_lag; lag <= c - least; ++lag) {
      const long begin = std::max(0L, -lag);
      const long end = std::min(m, c - lag);
      Score score;
      for (std::size_t k = 0; k < measured.size(); ++k)
        score.correlation +=
            correlation_at_lag(measured[k].values, computed[k].values, lag, begin, end);
      score.correlation /= static_cast<double>(measured.size());
      const double common = static_cast<double>(end - begin) / static_cast<double>(std::min(m, c));
      score.worth = score.correlation - loss_of_overlap * (1 - common);
      scores.push_back(score);
    }
  }

  /// The largest correlation that is parted from the best one by a valley.
  std::optional<double> runner_up(std::size_t best) const {
    std::optional<double> highest;
    const double floor = scores[best].correlation - 0.05;
    std::size_t left = best;
    while (left > 0 && scores[left].correlation > floor) --left;
    std::size_t right = best;
    while (right + 1 < scores.size() && scores[right].correlation > floor) ++right;
    for (std::size_t i = 0; i < scores.size(); ++i)
      if ((i < left || i > right) && (!highest || scores[i].correlation > *highest))
        highest = scores[i].correlation;
    return highest;
  }
};

/// The mean correlation at the record's own instants.
double fine_correlation(const std::vector<ChannelPair>& channels, double shift) {
  double sum = 0;
  for (const ChannelPair& channel : channels) {
    std::vector<double> measured;
    std::vector<double> computed;
    for (std::size_t i = 0; i < channel.measured.size(); ++i) {
      const double instant = channel.measured.time[i] + shift;
      if (instant < channel.computed.time.front() || instant > channel.computed.time.back())
        continue;
      measured.push_back(channel.measured.values[i]);
      computed.push_back(channel.computed.at(instant));
    }
    sum += correlation_of(measured, computed);
  }
  return sum / static_cast<double>(channels.size());
}

/// The largest value in an interval with one maximum, by the golden section.
template <class Function>
double find_maximum(double low, double high, const Function& value) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = high - ratio * (high - low);
  double b = low + ratio * (high - low);
  double at_a = value(a);
  double at_b = value(b);
  for (int i = 0; i < 40; ++i) {
    if (at_a >= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - ratio * (high - low);
      at_a = value(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + ratio * (high - low);
      at_b = value(b);
    }
  }
  return (low + high) / 2;
}

}  // namespace

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  return a.empty() ? 0 : correlation_at_lag(a, b, 0, 0, static_cast<long>(a.size()));
}

std::optional<TimeShift> find_time_shift(const std::vector<ChannelPair>& channels) {
  std::vector<ChannelPair> moving;
  for (const ChannelPair& channel : channels)
    if (moves(channel.measured) && moves(channel.computed)) moving.push_back(channel);
  if (moving.empty()) return std::nullopt;
  const TimeWindow measured = span_of(moving, &ChannelPair::measured);
  const TimeWindow computed = span_of(moving, &ChannelPair::computed);
  CoarseSearch search;
  search.step = std::max({mean_step(moving.front().measured), mean_step(moving.front().computed),
                          (measured.to - measured.from) / coarse_samples,
                          (computed.to - computed.from) / coarse_samples});
  for (const ChannelPair& channel : moving) {
    search.measured.push_back(evenly_sampled(channel.measured, measured, search.step));
    search.computed.push_back(evenly_sampled(channel.computed, computed, search.step));
  }
  search.run();
  if (search.scores.empty()) return std::nullopt;
  const auto best = static_cast<std::size_t>(
      std::max_element(search.scores.begin(), search.scores.end(),
                       [](const Score& a, const Score& b) { return a.worth < b.worth; }) -
      search.scores.begin());
  const double coarse =
      computed.from - measured.from +
      search.step * static_cast<double>(search.first_lag + static_cast<long>(best));
  TimeShift found;
  found.shift = find_maximum(coarse - search.step, coarse + search.step,
                             [&](double shift) { return fine_correlation(moving, shift); });
  found.correlation = fine_correlation(moving, found.shift);
  found.runner_up = search.runner_up(best);
  return found;
}

}  // namespace blocklift::pipeline
