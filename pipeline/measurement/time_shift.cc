#include "pipeline/measurement/time_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  std::vector<char> is_known;  ///< neither within a gap nor before or behind the series
  long known = 0;
};

/// @param span that all rows have in common.
EvenSeries evenly_sampled(const TimeSeries& series, const TimeWindow& span, double step) {
  EvenSeries even{span.from, {}, {}, 0};
  const std::vector<TimeWindow> gaps = gaps_of(series);
  const auto count = static_cast<std::size_t>(std::floor((span.to - span.from) / step)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double instant = even.start + static_cast<double>(i) * step;
    even.values.push_back(series.at(instant));
    const bool is_known = instant >= series.time.front() && instant <= series.time.back() &&
                          !is_in_gap(gaps, instant);
    even.is_known.push_back(is_known ? 1 : 0);
    even.known += is_known ? 1 : 0;
  }
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

/// Pearson's coefficient of pairs; 0 where one side is constant.
double correlation_of_pairs(const std::vector<std::pair<double, double>>& pairs) {
  if (pairs.empty()) return 0;
  const double size = static_cast<double>(pairs.size());
  double mean_a = 0;
  double mean_b = 0;
  for (const auto& [a, b] : pairs) {
    mean_a += a / size;
    mean_b += b / size;
  }
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (const auto& [one, other] : pairs) {
    const double a = one - mean_a;
    const double b = other - mean_b;
    aa += a * a;
    bb += b * b;
    ab += a * b;
  }
  const double smallest = 1e-18 * size * (mean_a * mean_a + mean_b * mean_b);
  if (aa <= smallest * mean_a * mean_a || bb <= smallest * mean_b * mean_b) return 0;
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// The samples of one row and those `lag` later in the other, where both are known; none where
/// these are less than a quarter of what the first row knows.
/// @param pairs is overwritten.
void take_pairs_at_lag(const EvenSeries& measured, const EvenSeries& computed, long lag,
                       std::vector<std::pair<double, double>>& pairs) {
  const auto m = static_cast<long>(measured.values.size());
  const auto c = static_cast<long>(computed.values.size());
  pairs.clear();
  for (long i = std::max(0L, -lag); i < std::min(m, c - lag); ++i)
    if (measured.is_known[i] && computed.is_known[i + lag])
      pairs.emplace_back(measured.values[i], computed.values[i + lag]);
  if (4 * static_cast<long>(pairs.size()) < std::min(measured.known, computed.known)) pairs.clear();
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
    std::vector<std::pair<double, double>> pairs;
    for (long lag = first_lag; lag <= c - least; ++lag) {
      const long begin = std::max(0L, -lag);
      const long end = std::min(m, c - lag);
      Score score;
      for (std::size_t k = 0; k < measured.size(); ++k) {
        take_pairs_at_lag(measured[k], computed[k], lag, pairs);
        score.correlation += correlation_of_pairs(pairs);
      }
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

double on_lift(const TimeShift& clock, double instant) {
  return instant + clock.shift + clock.rate * (instant - clock.middle);
}

/// The mean correlation at the record's own instants.
double fine_correlation(const std::vector<ChannelPair>& channels, const TimeShift& clock) {
  double sum = 0;
  for (const ChannelPair& channel : channels) {
    std::vector<double> measured;
    std::vector<double> computed;
    for (std::size_t i = 0; i < channel.measured.size(); ++i) {
      const double instant = on_lift(clock, channel.measured.time[i]);
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

/// Finds by which rate a record's clock differs, once its best shift is known.
class ClockRate {
 public:
  ClockRate(const std::vector<ChannelPair>& channels, const TimeWindow& record, double step)
      : record_(record), step_(step) {
    for (const ChannelPair& channel : channels)
      channels_.push_back({thinned(channel.measured), channel.computed});
  }

  /// The same clock, or one with a rate that explains at least half of what this one does not.
  TimeShift improve(const TimeShift& found) const {
    TimeShift clock = found;
    clock.middle = (record_.from + record_.to) / 2;
    const double third = record_.length() / 3;
    const std::vector<ChannelPair> first = part({record_.from, record_.from + third}),
                                   last = part({record_.to - third, record_.to});
    if (first.empty() || last.empty()) return found;
    const double before = shift_near(first, found.shift), behind = shift_near(last, found.shift);
    clock.rate = (behind - before) / (2 * third);
    clock.shift = (before + behind) / 2;
    if (std::abs(clock.rate) * record_.length() / 2 < step_ / 4) return found;
    for (int round = 0; round < 2; ++round) refine(clock);
    const double as_found = fine_correlation(channels_, found),
                 improved = fine_correlation(channels_, clock);
    const bool is_told = std::abs(clock.rate) <= largest_rate &&
                         1 - improved < (1 - as_found) / 2 && improved > least_correlation;
    return is_told ? clock : found;
  }

 private:
  static constexpr double largest_rate = 0.01, least_correlation = 0.7;
  static constexpr std::size_t enough = 1000, fewest = 24;

  static TimeSeries thinned(const TimeSeries& series) {
    const std::size_t stride = (series.size() + enough - 1) / enough;
    if (stride <= 1) return series;
    TimeSeries thin;
    for (std::size_t i = 0; i < series.size(); i += stride) {
      thin.time.push_back(series.time[i]);
      thin.values.push_back(series.values[i]);
    }
    return thin;
  }

  /// The channels that move in a part of the record.
  std::vector<ChannelPair> part(const TimeWindow& window) const {
    std::vector<ChannelPair> parts;
    for (const ChannelPair& channel : channels_) {
      TimeSeries samples = samples_in(channel.measured, window);
      if (samples.size() >= fewest && moves(samples))
        parts.push_back({std::move(samples), channel.computed});
    }
    return parts;
  }

  /// The best shift of a part; of those that are equally good the one nearest to `about`.
  double shift_near(const std::vector<ChannelPair>& channels, double about) const {
    constexpr int steps = 40;
    constexpr double equally_good = 0.005;
    const double reach = std::max(2 * step_, largest_rate * record_.length() / 2);
    const auto shift_at = [&](int i) { return about + reach * i / steps; };
    const auto worth = [&](double shift) { return fine_correlation(channels, {.shift = shift}); };
    std::vector<double> worths;
    for (int i = -steps; i <= steps; ++i) worths.push_back(worth(shift_at(i)));
    const double best = *std::max_element(worths.begin(), worths.end());
    const auto middle = worths.begin() + steps;
    const auto at = [&](int i) { return middle[i]; };
    const auto is_peak = [&](int i) {
      return at(i) >= best - equally_good && (i == -steps || at(i) >= at(i - 1)) &&
             (i == steps || at(i) >= at(i + 1));
    };
    int nearest = steps + 1;
    for (int i = -steps; i <= steps; ++i)
      if (is_peak(i) && std::abs(i) < std::abs(nearest)) nearest = i;
    return find_maximum(shift_at(nearest) - reach / steps, shift_at(nearest) + reach / steps,
                        worth);
  }

  void refine(TimeShift& clock) const {
    const double rate = clock.rate, shift = clock.shift,
                 apart = std::max(std::abs(rate) / 2, step_ / record_.length());
    const auto worth = [&](double of_rate, double of_shift) {
      TimeShift tried = clock;
      tried.rate = of_rate;
      tried.shift = of_shift;
      return fine_correlation(channels_, tried);
    };
    clock.rate =
        find_maximum(rate - apart, rate + apart, [&](double tried) { return worth(tried, shift); });
    clock.shift = find_maximum(shift - step_, shift + step_,
                               [&](double tried) { return worth(clock.rate, tried); });
  }

  std::vector<ChannelPair> channels_;
  TimeWindow record_;
  double step_;
};

}  // namespace

TimeSeries on_clock(TimeSeries series, const TimeShift& clock) {
  for (double& instant : series.time) instant = on_lift(clock, instant);
  for (TimeWindow& window : series.left_out)
    window = {on_lift(clock, window.from), on_lift(clock, window.to)};
  return series;
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) pairs.emplace_back(a[i], b[i]);
  return correlation_of_pairs(pairs);
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
  found.shift = find_maximum(coarse - search.step, coarse + search.step, [&](double shift) {
    return fine_correlation(moving, {.shift = shift});
  });
  found.runner_up = search.runner_up(best);
  found = ClockRate(moving, measured, search.step).improve(found);
  found.correlation = fine_correlation(moving, found);
  return found;
}

}  // namespace blocklift::pipeline
