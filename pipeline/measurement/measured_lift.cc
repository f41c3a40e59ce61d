#include "pipeline/measurement/measured_lift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/measurement/weighing_of_results.h"
#include "pipeline/report/input_values.h"

namespace blocklift::pipeline {
namespace {

[[noreturn]] void refuse(const std::string& place, std::string message,
                         std::vector<std::string> hints = {}) {
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(place), 0, 0}, std::move(message),
                    std::move(hints));
  throw InputError(diagnostics);
}

bool is_surrounding(const MeasuredChannel& channel) {
  return channel.name == wind_channel || channel.name == wave_channel;
}

/// The shift of one record, given or found.
AlignedRecord align(const MeasuredRecord& record, const std::vector<ChannelPair>& pairs,
                    const std::optional<double>& given, std::vector<std::string>& doubts) {
  AlignedRecord aligned{record.file, given.value_or(0), std::nullopt};
  if (given || pairs.empty()) return aligned;
  aligned.found = find_time_shift(pairs);
  if (!aligned.found)
    refuse(record.file,
           "nothing in this record or in what was computed of it moves, so that the "
           "two cannot be aligned",
           {"--shift says by how many seconds the clock of the lift is ahead of the record's"});
  aligned.shift = aligned.found->shift;
  if (aligned.found->is_doubtful())
    doubts.push_back(fmt::format(
        "the alignment of {} is to be doubted: its correlation is {:.2f}{}; --shift gives it",
        record.file, aligned.found->correlation,
        aligned.found->runner_up
            ? fmt::format(", that of another shift {:.2f}", *aligned.found->runner_up)
            : ""));
  return aligned;
}

/// Puts every record on the clock of the lift and takes its channels over.
void take_record(const MeasuredRecord& record, const ResultsReader& results,
                 const std::optional<double>& given, MeasuredLift& lift) {
  std::vector<HeldChannel> channels;
  std::vector<ChannelPair> pairs;
  for (const MeasuredChannel& channel : record.channels) {
    if (is_surrounding(channel)) continue;
    HeldChannel held{channel.name,
                     channel.unit,
                     channel.series,
                     read_computed_channel(results, channel.name),
                     {},
                     {},
                     {},
                     {}};
    if (held.computed.in_motion.size() < 2)
      refuse(record.file, fmt::format("the results have no values of \"{}\"", channel.name));
    pairs.push_back({held.measured, held.computed.in_motion});
    channels.push_back(std::move(held));
  }
  lift.records.push_back(align(record, pairs, given, lift.doubts));
  for (HeldChannel& channel : channels) {
    channel.measured = shifted(std::move(channel.measured), lift.records.back().shift);
    lift.channels.push_back(std::move(channel));
  }
  for (const MeasuredChannel& channel : record.channels) {
    if (channel.name == wind_channel) lift.wind = wind_of(channel.series);
    if (channel.name == wave_channel) lift.waves = waves_of(channel.series);
  }
}

TimeWindow whole_time() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {-infinity, infinity};
}

/// The time that all of several series and a window have.
TimeWindow common_time(const std::vector<TimeSeries>& series, TimeWindow window) {
  for (const TimeSeries& one : series) {
    window.from = std::max(window.from, one.time.front());
    window.to = std::min(window.to, one.time.back());
  }
  return window;
}

/// Says where channels have gaps: what was measured there is not known.
void doubt_gaps(MeasuredLift& lift) {
  for (const HeldChannel& channel : lift.channels) {
    const std::vector<TimeWindow> gaps = gaps_of(channel.measured);
    if (gaps.empty()) continue;
    const TimeWindow& longest = *std::max_element(
        gaps.begin(), gaps.end(),
        [](const TimeWindow& a, const TimeWindow& b) { return a.length() < b.length(); });
    lift.doubts.push_back(gaps.size() == 1
                              ? fmt::format("{} has nothing from {:.1f} s to {:.1f} s",
                                            channel.name, longest.from, longest.to)
                              : fmt::format("{} has {} gaps, the longest from {:.1f} s to {:.1f} s",
                                            channel.name, gaps.size(), longest.from, longest.to));
  }
}

void compare_channels(const TimeWindow& window, MeasuredLift& lift) {
  for (HeldChannel& channel : lift.channels) {
    channel.agreement = compare_series(channel.measured, channel.computed.in_motion,
                                       channel.computed.at_rest, window);
    if (!channel.agreement)
      lift.doubts.push_back(
          fmt::format("{} has less than two instants in the time that is compared", channel.name));
  }
}

/// May the record be what was computed and noise? Of a load that hangs almost still the noise is
/// larger than what moves, so that even a sound cell has no correlation.
bool may_be_noise(double scale, double deviation) {
  constexpr double deviations = 3;
  return std::abs(scale - 1) <= deviations * deviation;
}

/// What makes a channel doubtful as a whole: a dead cell, another channel, another unit or sign.
/// Empty: nothing does.
std::string doubt_of(const HeldChannel& channel, const TimeWindow& window) {
  constexpr double least_correlation = 0.7, least_scale = 0.5, largest_scale = 2;
  if (!channel.agreement) return {};
  const std::vector<double> values = samples_in(channel.measured, window).values;
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  if (lowest != values.end() && *lowest == *highest)
    return fmt::format("is {:.6g} {} at every instant: the cell or its channel may be dead",
                       *lowest, channel.unit);
  // A mean tells a tension's unit even where nothing moves. Other quantities have a zero of their
  // own.
  const double ratio = channel.agreement->ratio_of_means;
  const bool has_wrong_mean = channel.unit == "N" &&
                              std::abs(ratio) < std::numeric_limits<double>::infinity() &&
                              !(ratio >= least_scale && ratio <= largest_scale);
  const std::string wrong_mean = fmt::format(
      "is {:.4g} times the computed one on average: its unit or its zero may be another", ratio);
  // Where nothing moves in the computed lift there is nothing that a record could follow.
  if (!channel.agreement->scale ||
      may_be_noise(*channel.agreement->scale, channel.agreement->scale_deviation))
    return has_wrong_mean ? wrong_mean : std::string();
  const double correlation = channel.agreement->correlation, scale = *channel.agreement->scale;
  if (correlation < least_correlation)
    return fmt::format("does not follow the computed one, its correlation is {:.2f}{}", correlation,
                       correlation < -least_correlation ? ": its sign may be reversed" : "");
  if (scale < least_scale || scale > largest_scale)
    return fmt::format("moves {:.4g} times as much as the computed one: its unit may be another",
                       scale);
  return has_wrong_mean ? wrong_mean : std::string();
}

/// How far each sample stands out from both its neighbours, to one side; 0 where it lies between.
std::vector<double> leaps_of(const std::vector<double>& values) {
  std::vector<double> leaps(values.size(), 0);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const double before = values[i] - values[i - 1], after = values[i] - values[i + 1];
    if (before * after > 0) leaps[i] = std::min(std::abs(before), std::abs(after));
  }
  return leaps;
}

/// Says where tensions have samples that stand alone: one makes a largest load, and spoils a
/// correlation. They leap ten times as far as 19 of 20 samples and as all that was computed, and by
/// a twentieth of the largest load at least.
void doubt_leaps(const TimeWindow& window, MeasuredLift& lift) {
  constexpr double far = 10, least_share = 0.05;
  for (const HeldChannel& channel : lift.channels) {
    if (channel.unit != "N" || !channel.agreement) continue;
    const TimeSeries ours = samples_in(channel.measured, window);
    std::vector<double> theirs;
    for (const double instant : ours.time) theirs.push_back(channel.computed.in_motion.at(instant));
    const std::vector<double> leaps = leaps_of(ours.values), computed = leaps_of(theirs);
    std::vector<double> sorted = leaps;
    const auto usual = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 19 / 20);
    std::nth_element(sorted.begin(), usual, sorted.end());
    const double limit = std::max({far * *usual, far * *std::ranges::max_element(computed),
                                   least_share * channel.agreement->largest_computed});
    const auto stands_alone = [&](double leap) { return leap > limit; };
    const auto first = std::ranges::find_if(leaps, stands_alone);
    if (first == leaps.end()) continue;
    const auto count = std::ranges::count_if(leaps, stands_alone);
    lift.doubts.push_back(fmt::format(
        "{} leaps at {}, at {:.1f} s first: the cell or its line may have failed there, and its "
        "largest load and correlation may be made of that",
        channel.name, count == 1 ? "one sample" : fmt::format("{} samples", count),
        ours.time[static_cast<std::size_t>(first - leaps.begin())]));
  }
}

void doubt_channels(const TimeWindow& window, MeasuredLift& lift) {
  for (HeldChannel& channel : lift.channels) {
    const std::string doubt = doubt_of(channel, window);
    channel.is_doubtful = !doubt.empty();
    if (channel.is_doubtful) lift.doubts.push_back(channel.name + ' ' + doubt);
  }
}

void share_ropes(const TimeWindow& window, MeasuredLift& lift) {
  std::vector<HeldChannel*> ropes;
  std::vector<TimeSeries> measured;
  std::vector<TimeSeries> computed;
  for (HeldChannel& channel : lift.channels) {
    if (channel.name.rfind("ropes.", 0) != 0) continue;
    ropes.push_back(&channel);
    measured.push_back(channel.measured);
    computed.push_back(channel.computed.in_motion);
  }
  if (ropes.size() < 2) return;
  const TimeWindow common = common_time(computed, common_time(measured, window));
  if (common.from >= common.to) return;
  const std::vector<Sharing> shares = find_sharing(measured, computed, common);
  for (std::size_t i = 0; i < ropes.size(); ++i) ropes[i]->sharing = shares[i];
}

/// Of two oscillations that beat one fit finds a damping of its own, even below zero. The computed
/// motion has no noise: what one oscillation leaves of it are others.
void doubt_beats(MeasuredLift& lift) {
  constexpr double rules_alone = 0.98;
  std::vector<std::string> names;
  for (const HeldChannel& channel : lift.channels) {
    const auto& ours = channel.measured_decay;
    const auto& theirs = channel.computed_decay;
    if ((ours && ours->damping_ratio < -2 * ours->damping_deviation) ||
        (theirs && theirs->explained < rules_alone))
      names.push_back(channel.name);
  }
  if (names.empty()) return;
  lift.doubts.push_back(fmt::format(
      "more than one oscillation is in {}: the period and the damping of one that was fitted are "
      "farther off than their deviations say",
      list_of_names(names)));
}

void identify_decays(const TimeWindow& window, MeasuredLift& lift) {
  lift.looked_for_decay = true;
  for (HeldChannel& channel : lift.channels) {
    channel.measured_decay = fit_decay(samples_in(channel.measured, window));
    channel.computed_decay = fit_decay(samples_in(channel.computed.in_motion, window));
  }
  if (std::none_of(lift.channels.begin(), lift.channels.end(),
                   [](const HeldChannel& channel) { return channel.measured_decay.has_value(); }))
    lift.doubts.push_back(
        fmt::format("in no measured quantity does one free oscillation rule from {:g} s to {:g} s",
                    window.from, window.to));
  doubt_beats(lift);
}

/// A quantity of the case file whose key ends so; none where it is not there, or an expression.
std::optional<double> input_quantity(const ComparedResult& result, const std::string& ending,
                                     Dimension dimension) {
  if (result.input.empty()) return std::nullopt;
  for (const InputValue& value : list_input_values(result.input.front().yaml)) {
    const std::string key = '.' + value.key;
    if (key.size() < ending.size() ||
        key.compare(key.size() - ending.size(), ending.size(), ending) != 0)
      continue;
    try {
      return parse_quantity(value.value, dimension);
    } catch (const QuantityError&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

bool has_unreadable_gravity(const ComparedResult& result) {
  if (result.input.empty()) return false;
  const std::vector<InputValue> values = list_input_values(result.input.front().yaml);
  return std::any_of(values.begin(), values.end(),
                     [](const InputValue& value) { return value.key == "gravity"; }) &&
         !input_quantity(result, ".gravity", Dimension::acceleration);
}

/// What the block's own file says, of results without stress.
void take_stated_mass(MeasuredLift& lift) {
  const auto value_of = [](const std::string& yaml, const std::string& key) -> std::string {
    for (const InputValue& value : list_input_values(yaml))
      if (value.key == key) return value.value;
    return {};
  };
  const std::vector<InputText>& input = lift.result.input;
  if (input.empty()) return;
  const std::string model = value_of(input.front().yaml, "load.model");
  const auto block = std::find_if(input.begin() + 1, input.end(),
                                  [&](const InputText& one) { return one.name == model; });
  if (model.empty() || block == input.end()) return;
  try {
    if (const std::string mass = value_of(block->yaml, "mass"); !mass.empty())
      lift.weight->computed_mass = parse_quantity(mass, Dimension::mass);
    std::string list = value_of(block->yaml, "centre_of_mass");
    std::erase_if(list, [](char c) { return c == '[' || c == ']'; });
    std::istringstream parts(list);
    std::vector<double> centre;
    for (std::string part; std::getline(parts, part, ',');)
      centre.push_back(parse_quantity(part, Dimension::length));
    if (centre.size() == 3)
      lift.weight->computed_centre_B = Eigen::Vector3d(centre[0], centre[1], centre[2]);
  } catch (const QuantityError&) {
    // An expression: what it comes to is not known here.
  }
}

void weigh_load(const ResultsReader& results, const MeasurementSettings& settings,
                MeasuredLift& lift) {
  const TimeWindow& window = *settings.rest;
  const std::string place = fmt::format("--rest {:g}:{:g}", window.from, window.to);
  const std::vector<std::string> ropes = ropes_at_load(results);
  if (ropes.empty()) refuse(place, "these results know of no rope at the load");
  std::map<std::string, TimeSeries> tensions;
  for (const HeldChannel& channel : lift.channels) tensions[channel.name] = channel.measured;
  std::vector<std::string> missing;
  for (const std::string& rope : ropes)
    if (tensions.count(rope) == 0) missing.push_back(rope);
  if (!missing.empty())
    refuse(place, "the load cannot be weighed: not every rope at it was measured",
           {"what lacks is " + list_of_names(missing)});
  if (has_unreadable_gravity(lift.result))
    refuse(place, "gravity stands in the case as an expression, which is not followed here",
           {"write it as a number with its unit"});
  const double gravity = input_quantity(lift.result, ".gravity", Dimension::acceleration)
                             .value_or(newton_per_tonne / 1000);
  const auto weighing =
      weigh(weighing_instants(results, tensions, window), gravity, settings.cell_accuracy);
  if (!weighing)
    refuse(place, "the records of all ropes have less than 20 instants in common there");
  lift.weight = HeldWeight{*weighing, window, std::nullopt, std::nullopt};
  // The balance needs every rope: a doubtful cell cannot be left out, so that its part is said.
  std::vector<std::string> doubtful;
  for (const HeldChannel& channel : lift.channels)
    if (channel.is_doubtful && std::ranges::find(ropes, channel.name) != ropes.end())
      doubtful.push_back(channel.name);
  if (!doubtful.empty())
    lift.doubts.push_back("the measured mass and its centre are made of doubtful channels, too: " +
                          list_of_names(doubtful));
  take_stated_mass(lift);
  const nlohmann::ordered_json& summary = lift.result.summary;
  if (summary.contains("structure") && summary["structure"].contains("mass")) {
    const auto& block = summary["structure"]["mass"];
    if (block.contains("total_kg") && block["total_kg"].is_number())
      lift.weight->computed_mass = block["total_kg"].get<double>();
    if (block.contains("centre_of_mass_m")) {
      const auto& c = block["centre_of_mass_m"];
      if (std::all_of(c.begin(), c.end(), [](const auto& one) { return one.is_number(); }))
        lift.weight->computed_centre_B =
            Eigen::Vector3d(c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
    }
  }
  // Where the measurement knows a line only, its point at the computed height can be compared.
  const auto& computed = lift.weight->computed_centre_B;
  if (const auto open = weighing->open_coordinate(); open && computed)
    lift.weight->measured = weighing->with_open_coordinate((*computed)[*open]);
}

}  // namespace

TimeWindow parse_window(const std::string& option, const std::string& text) {
  const std::string place = option + ' ' + text;
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    refuse(place, "two instants of the lift are due, in seconds, for example 10:25");
  try {
    const TimeWindow window{parse_number(text.substr(0, colon)),
                            parse_number(text.substr(colon + 1))};
    if (window.from >= window.to) refuse(place, "the second instant must be later than the first");
    return window;
  } catch (const QuantityError& error) {
    refuse(place, error.what());
  }
}

MeasuredLift hold_against_measurements(const std::filesystem::path& result,
                                       const std::vector<std::filesystem::path>& records,
                                       const MeasurementSettings& settings) {
  if (settings.shifts.size() > 1 && settings.shifts.size() != records.size())
    refuse("--shift", fmt::format("there are {} shifts for {} records; one for all or one for each "
                                  "is due",
                                  settings.shifts.size(), records.size()));
  MeasuredLift lift;
  lift.result = read_compared_result(result);
  const ResultsReader results(lift.result.folder / layout::results_file);
  const std::vector<MeasuredRecord> read = read_records(records, results);
  for (std::size_t i = 0; i < read.size(); ++i) {
    std::optional<double> given;
    if (!settings.shifts.empty())
      given = settings.shifts.size() == 1 ? settings.shifts.front() : settings.shifts[i];
    take_record(read[i], results, given, lift);
  }
  lift.computed_wind = input_quantity(lift.result, ".wind.speed", Dimension::speed);
  lift.computed_wave_height =
      input_quantity(lift.result, ".spectrum.significant_height", Dimension::length);
  const TimeWindow window = settings.window.value_or(whole_time());
  doubt_gaps(lift);
  compare_channels(window, lift);
  doubt_leaps(window, lift);
  doubt_channels(window, lift);
  share_ropes(window, lift);
  if (settings.decay) identify_decays(*settings.decay, lift);
  if (settings.rest) weigh_load(results, settings, lift);
  return lift;
}

}  // namespace blocklift::pipeline
