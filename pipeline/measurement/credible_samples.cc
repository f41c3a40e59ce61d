#include "pipeline/measurement/credible_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algebra/quantile.h"
#include "pipeline/measurement/load_changes.h"
#include "pipeline/measurement/measured_tables.h"
#include "pipeline/measurement/snatches.h"

namespace blocklift::pipeline {
namespace {

/// Samples on one side of a jump that tell its level, and samples about a leap in which the
/// computed quantity may do the same.
constexpr std::size_t samples_of_a_level = 20, samples_about_a_leap = 2;
constexpr std::size_t longest_spike = 3, shortest_stand = 8;

/// The shortest leap that is no step as usual.
double shortest_leap(const std::vector<double>& values, bool is_tension) {
  constexpr double far = 10, usual = 0.95, of_load = 0.05, of_range = 0.5, tail = 0.025;
  std::vector<double> steps, sizes;
  for (std::size_t i = 1; i < values.size(); ++i)
    steps.push_back(std::abs(values[i] - values[i - 1]));
  const double by_steps = far * algebra::quantile_of(std::move(steps), usual);
  if (!is_tension)
    return std::max(by_steps, of_range * (algebra::quantile_of(values, 1 - tail) -
                                          algebra::quantile_of(values, tail)));
  for (const double value : values) sizes.push_back(std::abs(value));
  return std::max(by_steps, of_load * algebra::quantile_of(std::move(sizes), usual));
}

/// Samples that stand off from the median of the seven about them.
std::vector<FaultySamples> find_spikes(const std::vector<double>& values, double limit) {
  std::vector<FaultySamples> spikes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = i < longest_spike ? 0 : i - longest_spike,
                      last = std::min(i + longest_spike, values.size() - 1);
    const double middle =
        algebra::quantile_of({values.begin() + static_cast<std::ptrdiff_t>(first),
                              values.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                             0.5);
    const double leap = values[i] - middle;
    if (std::abs(leap) <= limit) continue;
    if (!spikes.empty() && spikes.back().end == i) {
      spikes.back().end = i + 1;
      if (std::abs(leap) > std::abs(spikes.back().leap)) spikes.back().leap = leap;
    } else {
      spikes.push_back({Fault::spike, i, i + 1, leap});
    }
  }
  return spikes;
}

/// Samples that stand off together from those before and behind them, and jumps that are not
/// undone.
class LeapPairs {
 public:
  /// @param places of the samples that count, in order.
  LeapPairs(const std::vector<double>& values, std::vector<std::size_t> places, double limit)
      : values_(values), places_(std::move(places)), limit_(limit) {}

  std::vector<FaultySamples> find() {
    std::size_t open = 0;  // the leap that is not undone yet; 0: none
    for (std::size_t k = 1; k < places_.size(); ++k) {
      if (std::abs(step(k)) <= limit_) continue;
      if (open > 0 && std::abs(stand_off(open, k)) > limit_) {
        add_drop_out(open, k);
        open = 0;
        continue;
      }
      if (open > 0) add_jump(open);
      open = k;
    }
    if (open > 0) add_jump(open);
    return std::move(found_);
  }

 private:
  double value(std::size_t k) const { return values_[places_[k]]; }
  double step(std::size_t k) const { return value(k) - value(k - 1); }

  /// How far all of [begin, end) lie above or, less than zero, below both neighbours.
  double stand_off(std::size_t begin, std::size_t end) const {
    double lowest = value(begin), highest = lowest;
    for (std::size_t k = begin; k < end; ++k) {
      lowest = std::min(lowest, value(k));
      highest = std::max(highest, value(k));
    }
    const auto [low, high] = std::minmax({value(begin - 1), value(end)});
    if (lowest > high) return lowest - high;
    return highest < low ? highest - low : 0;
  }

  /// A filter spreads a leap over two samples: the one that lies between goes with the others.
  void add_drop_out(std::size_t begin, std::size_t end) {
    const double leap = stand_off(begin, end);
    if (begin > 1 && step(begin - 1) * leap > 0 && std::abs(step(begin - 1)) > limit_ / 2) --begin;
    if (end + 1 < places_.size() && step(end + 1) * leap < 0 &&
        std::abs(step(end + 1)) > limit_ / 2)
      ++end;
    found_.push_back({Fault::drop_out, places_[begin], places_[end], leap});
  }
  void add_jump(std::size_t k) {
    found_.push_back({Fault::restart, places_[k], places_[k], step(k)});
  }

  const std::vector<double>& values_;
  std::vector<std::size_t> places_;
  double limit_;
  std::vector<FaultySamples> found_;
};

/// Do the samples begin or end with a leap?
bool leaps_at_an_end(const std::vector<double>& values, const FaultySamples& run, double limit) {
  const auto leaps_at = [&](std::size_t i) {
    return i > 0 && i < values.size() && std::abs(values[i] - values[i - 1]) > limit;
  };
  return leaps_at(run.begin) || leaps_at(run.end);
}

/// Runs of equal samples that noise would not leave. One that lasts almost all the time is a dead
/// channel, which is told otherwise.
std::vector<FaultySamples> find_stands(const std::vector<double>& values, double limit) {
  constexpr double rare = 0.02, almost_all = 0.8;
  std::vector<FaultySamples> runs;
  std::size_t equal_elsewhere = 0, in_runs = 0;
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    for (end = begin + 1; end < values.size() && values[end] == values[begin];) ++end;
    if (end - begin < shortest_stand) {
      equal_elsewhere += end - begin - 1;
      continue;
    }
    in_runs += end - begin;
    runs.push_back({Fault::stuck, begin, end, 0});
  }
  const auto others = static_cast<double>(values.size() - in_runs);
  const bool is_rare = static_cast<double>(equal_elsewhere) <= rare * others;
  std::erase_if(runs, [&](const FaultySamples& run) {
    return static_cast<double>(run.end - run.begin) >
               almost_all * static_cast<double>(values.size()) ||
           !(is_rare || leaps_at_an_end(values, run, limit));
  });
  return runs;
}

std::vector<bool> marked(const std::vector<FaultySamples>& faults, std::size_t size) {
  std::vector<bool> is_marked(size, false);
  for (const FaultySamples& one : faults)
    for (std::size_t i = one.begin; i < one.end; ++i) is_marked[i] = true;
  return is_marked;
}

/// Of the stretches between jumps all but the longest.
void choose_between_jumps(std::vector<FaultySamples>& faults, std::size_t size) {
  std::vector<FaultySamples> jumps;
  for (const FaultySamples& one : faults)
    if (one.fault == Fault::restart) jumps.push_back(one);
  if (jumps.empty()) return;
  std::erase_if(faults, [](const FaultySamples& one) { return one.fault == Fault::restart; });
  std::vector<FaultySamples> stretches{
      {Fault::restart, 0, jumps.front().begin, jumps.front().leap}};
  for (std::size_t k = 0; k < jumps.size(); ++k)
    stretches.push_back({Fault::restart, jumps[k].begin,
                         k + 1 < jumps.size() ? jumps[k + 1].begin : size, jumps[k].leap});
  const auto longest = std::max_element(stretches.begin(), stretches.end(),
                                        [](const FaultySamples& a, const FaultySamples& b) {
                                          return a.end - a.begin < b.end - b.begin;
                                        });
  stretches.erase(longest);
  faults.insert(faults.end(), stretches.begin(), stretches.end());
}

/// Suspects of a series beside what was computed at its instants.
class Judge {
 public:
  Judge(const TimeSeries& measured, const TimeSeries& computed, bool is_tension,
        const std::vector<TensionPair>& others)
      : measured_(measured),
        own_{&measured, &computed},
        others_(others),
        is_tension_(is_tension),
        limit_(shortest_leap(measured.values, is_tension)) {
    std::vector<double> ours, theirs;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      computed_.push_back(computed.at(measured.time[i]));
      const bool is_common =
          measured.time[i] >= computed.time.front() && measured.time[i] <= computed.time.back();
      is_common_.push_back(is_common);
      if (!is_common) continue;
      ours.push_back(measured.values[i]);
      theirs.push_back(computed_.back());
    }
    if (ours.empty()) return;
    const auto range = [](const std::vector<double>& values) {
      return algebra::quantile_of(values, 0.95) - algebra::quantile_of(values, 0.05);
    };
    // A cell may be in another unit, or its sign reversed; other quantities have an own zero.
    const double load = typical_load(ours), computed_load = typical_load(theirs);
    if (is_tension && load != 0 && computed_load != 0) scale_ = load / computed_load;
    least_motion_ = is_tension ? 0.02 * std::abs(load) : 0.1 * range(ours);
  }

  JudgedSamples judge(const std::vector<FaultySamples>& suspects) const {
    JudgedSamples judged;
    std::vector<FaultySamples>& faults = judged.faults;
    for (const FaultySamples& one : suspects)
      if (one.fault != Fault::restart && is_common(one) && is_contradicted(one))
        faults.push_back(one);
    if (is_tension_) {
      judged.snatches = Snatches(measured_.values, limit_).among(faults);
      std::erase_if(faults, [&](const FaultySamples& one) {
        return std::ranges::any_of(judged.snatches, [&](const FaultySamples& snatch) {
          return snatch.fault == one.fault && snatch.begin == one.begin;
        });
      });
    }
    const std::vector<bool> is_faulty = marked(faults, measured_.size());
    const std::vector<FaultySamples> jumps = jumps_of(suspects);
    for (std::size_t k = 0; k < jumps.size(); ++k) {
      const std::size_t from = k > 0 ? jumps[k - 1].begin : 0,
                        to = k + 1 < jumps.size() ? jumps[k + 1].begin : measured_.size();
      if (!is_common(jumps[k]) || !is_own_jump(jumps[k], from, to, is_faulty)) continue;
      const bool is_of_load = is_tension_ && is_load_change(own_, jumps[k].begin, others_);
      (is_of_load ? judged.load_changes : faults).push_back(jumps[k]);
    }
    choose_between_jumps(faults, measured_.size());
    return judged;
  }

 private:
  bool is_common(const FaultySamples& one) const {
    return is_common_[one.begin] && is_common_[one.end > one.begin ? one.end - 1 : one.begin];
  }

  /// How far the computed quantity moves over samples, in the measured one's unit.
  double motion_over(std::size_t begin, std::size_t end) const {
    const auto at = [&](std::size_t i) {
      return computed_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto [low, high] = std::minmax_element(at(begin), at(end));
    return std::abs(scale_) * (*high - *low);
  }

  bool is_contradicted(const FaultySamples& one) const {
    if (one.fault == Fault::stuck)
      return motion_over(one.begin, one.end) > least_motion_ && !is_slack_rope(one);
    const std::size_t begin = one.begin - std::min(one.begin, samples_about_a_leap),
                      end = std::min(one.end + samples_about_a_leap, measured_.size());
    return motion_over(begin, end) < std::abs(one.leap) / 2;
  }

  /// A rope without tension reads one value as well. It comes to it and leaves it without a leap,
  /// which a line that is torn does not.
  bool is_slack_rope(const FaultySamples& one) const {
    return is_tension_ && std::abs(measured_.values[one.begin]) <= least_motion_ &&
           !leaps_at_an_end(measured_.values, one, limit_);
  }

  static std::vector<FaultySamples> jumps_of(const std::vector<FaultySamples>& suspects) {
    std::vector<FaultySamples> jumps;
    std::ranges::copy_if(suspects, std::back_inserter(jumps),
                         [](const FaultySamples& one) { return one.fault == Fault::restart; });
    std::ranges::sort(jumps, {}, &FaultySamples::begin);
    return jumps;
  }

  /// The level of measured less computed over the first (or the last) samples of [begin, end) that
  /// are no faults and that were computed; none if there are none.
  std::optional<double> level(std::size_t begin, std::size_t end, bool at_begin,
                              const std::vector<bool>& is_faulty) const {
    std::vector<double> values;
    for (std::size_t k = begin; k < end && values.size() < samples_of_a_level; ++k) {
      const std::size_t i = at_begin ? k : begin + end - 1 - k;
      if (!is_faulty[i] && is_common_[i])
        values.push_back(measured_.values[i] - scale_ * computed_[i]);
    }
    if (values.empty()) return std::nullopt;
    return algebra::quantile_of(std::move(values), 0.5);
  }

  /// Measured less computed jumps as far as the measured quantity does, or half of it at least,
  /// about the jump and for good: over the stretches [from, jump) and [jump, to) as well.
  bool is_own_jump(const FaultySamples& one, std::size_t from, std::size_t to,
                   const std::vector<bool>& is_faulty) const {
    const auto first = level(from, one.begin, true, is_faulty),
               before = level(from, one.begin, false, is_faulty),
               behind = level(one.begin, to, true, is_faulty),
               last = level(one.begin, to, false, is_faulty);
    if (!first || !before || !behind || !last) return false;
    const auto is_as_far = [&](double jump) {
      return jump * one.leap > 0 && std::abs(jump) > std::abs(one.leap) / 2;
    };
    return is_as_far(*behind - *before) && is_as_far(*last - *first);
  }

  const TimeSeries& measured_;
  TensionPair own_;
  const std::vector<TensionPair>& others_;
  std::vector<double> computed_;
  std::vector<bool> is_common_;
  bool is_tension_;
  double limit_;  ///< the shortest leap
  double scale_ = 1, least_motion_ = 0;
};

}  // namespace

std::vector<FaultySamples> find_suspects(const TimeSeries& series, bool is_tension) {
  const std::vector<double>& values = series.values;
  if (values.size() < shortest_stand) return {};
  const double limit = shortest_leap(values, is_tension);
  if (!(limit > 0)) return {};
  std::vector<FaultySamples> suspects = find_spikes(values, limit);
  const std::vector<bool> is_spike = marked(suspects, values.size());
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!is_spike[i]) places.push_back(i);
  for (const FaultySamples& one : LeapPairs(values, std::move(places), limit).find())
    suspects.push_back(one);
  // Zeros of a drop-out stand still, too.
  std::vector<FaultySamples> stands = find_stands(values, limit);
  std::erase_if(stands, [&](const FaultySamples& run) {
    return std::any_of(suspects.begin(), suspects.end(), [&](const FaultySamples& one) {
      return one.begin <= run.begin && run.end <= one.end;
    });
  });
  suspects.insert(suspects.end(), stands.begin(), stands.end());
  return suspects;
}

JudgedSamples judge_samples(const TimeSeries& measured, const TimeSeries& computed, bool is_tension,
                            const std::vector<TensionPair>& others) {
  const std::vector<FaultySamples> suspects = find_suspects(measured, is_tension);
  if (suspects.empty()) return {};
  return Judge(measured, computed, is_tension, others).judge(suspects);
}

std::vector<FaultySamples> find_faults(const TimeSeries& measured, const TimeSeries& computed,
                                       bool is_tension) {
  return judge_samples(measured, computed, is_tension).faults;
}

std::vector<FaultySamples> suspects_as_faults(std::vector<FaultySamples> suspects,
                                              std::size_t size) {
  choose_between_jumps(suspects, size);
  return suspects;
}

TimeSeries without(const TimeSeries& series, const std::vector<FaultySamples>& faults) {
  if (faults.empty()) return series;
  const std::vector<bool> is_faulty = marked(faults, series.size());
  TimeSeries left;
  std::vector<TimeWindow> windows;
  bool is_open = false;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (is_faulty[i]) {
      is_open = true;
      continue;
    }
    if (is_open && left.size() > 0) windows.push_back({left.time.back(), series.time[i]});
    is_open = false;
    left.time.push_back(series.time[i]);
    left.values.push_back(series.values[i]);
  }
  left.left_out = std::move(windows);
  return left;
}

std::size_t count_left_out(const std::vector<FaultySamples>& faults, std::size_t size) {
  const std::vector<bool> is_faulty = marked(faults, size);
  return static_cast<std::size_t>(std::count(is_faulty.begin(), is_faulty.end(), true));
}

std::string leaps_in_words(const std::vector<FaultySamples>& leaps, const std::string& name,
                           const std::string& plural, const TimeSeries& series,
                           const std::string& unit) {
  const auto [shown, factor] = shown_unit(unit);
  const FaultySamples& farthest = *std::max_element(
      leaps.begin(), leaps.end(), [](const FaultySamples& a, const FaultySamples& b) {
        return std::abs(a.leap) < std::abs(b.leap);
      });
  const double leap = factor * farthest.leap;
  return fmt::format(
      "{} {} {} at {:.1f} s",
      leaps.size() == 1 ? fmt::format("a {} of", name)
                        : fmt::format("{} {}, the farthest of", leaps.size(), plural),
      std::abs(leap) < 1000 ? fmt::format("{:+.4g}", leap) : fmt::format("{:+.0f}", leap), shown,
      series.time[farthest.begin]);
}

std::string faults_in_words(const std::vector<FaultySamples>& faults, const TimeSeries& series,
                            const std::string& unit) {
  constexpr std::size_t few = 3;
  std::map<Fault, std::vector<FaultySamples>> by_kind;
  for (const FaultySamples& one : faults) by_kind[one.fault].push_back(one);
  std::string text;
  for (const auto& [fault, all] : by_kind) {
    const auto from = [&](const FaultySamples& one) { return series.time[one.begin]; };
    text += text.empty() ? "" : "; ";
    if (fault == Fault::spike) {
      text += leaps_in_words(all, "spike", "spikes", series, unit);
      continue;
    }
    text += fault == Fault::drop_out ? "it leaps away and back"
            : fault == Fault::stuck  ? "it stands still while the computed one moves"
                                     : "it jumps as the computed one does not, and its zero may be "
                                       "another";
    for (std::size_t k = 0; k < std::min(few, all.size()); ++k)
      text += fmt::format("{} from {:.1f} s to {:.1f} s", k == 0 ? "" : ",", from(all[k]),
                          series.time[all[k].end - 1]);
    if (all.size() > few) text += fmt::format(" and {} times more", all.size() - few);
  }
  return text;
}

}  // namespace blocklift::pipeline
