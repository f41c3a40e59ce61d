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

/// What is known of a stretch of time at least, if anything is to be made of it.
constexpr double least_known_share = 0.5;

bool is_surrounding(const MeasuredChannel& channel) {
  return channel.name == wind_channel || channel.name == wave_channel;
}

/// Says how the clock of one record was found.
AlignedRecord record_of(const MeasuredRecord& record, const AlignedChannels& aligned, bool is_given,
                        std::vector<std::string>& doubts) {
  AlignedRecord one{record.file, aligned.clock.shift, std::nullopt, is_given};
  if (!aligned.is_found) return one;
  one.found = aligned.clock;
  if (one.found->is_doubtful())
    doubts.push_back(fmt::format(
        "the alignment of {} is to be doubted: its correlation is {:.2f}{}; --shift gives it",
        record.file, one.found->correlation,
        one.found->runner_up ? fmt::format(", that of another shift {:.2f}", *one.found->runner_up)
                             : ""));
  if (one.found->rate != 0)
    doubts.push_back(fmt::format(
        "the clock of {} is {:.2g} % {}, which was put right: the shift is that of its middle",
        record.file, 100 * std::abs(one.found->rate), one.found->rate > 0 ? "slow" : "fast"));
  return one;
}

/// Says where a channel has gaps: what was measured there is not known.
void doubt_gaps(const HeldChannel& channel, std::vector<std::string>& doubts) {
  const std::vector<TimeWindow> gaps = gaps_of(channel.measured);
  if (gaps.empty()) return;
  const TimeWindow& longest = *std::max_element(
      gaps.begin(), gaps.end(),
      [](const TimeWindow& a, const TimeWindow& b) { return a.length() < b.length(); });
  doubts.push_back(gaps.size() == 1
                       ? fmt::format("{} has nothing from {:.1f} s to {:.1f} s", channel.name,
                                     longest.from, longest.to)
                       : fmt::format("{} has {} gaps, the longest from {:.1f} s to {:.1f} s",
                                     channel.name, gaps.size(), longest.from, longest.to));
}

/// Takes a channel over without what is not believed of it, and says so.
void leave_out(const std::vector<FaultySamples>& faults, HeldChannel& channel,
               std::vector<std::string>& doubts) {
  channel.samples = channel.measured.size();
  if (faults.empty()) return;
  for (const FaultySamples& one : faults)
    channel.left_out.push_back(
        {one.fault,
         {channel.measured.time[one.begin], channel.measured.time[one.end - 1]},
         one.end - one.begin});
  const std::size_t lost = count_left_out(faults, channel.samples);
  channel.is_refused = 2 * lost > channel.samples;
  channel.is_doubtful = channel.is_refused;
  doubts.push_back(fmt::format(
      "{}: {} of {} samples are left out ({:.1f} %): {}{}", channel.name, lost, channel.samples,
      100 * static_cast<double>(lost) / static_cast<double>(channel.samples),
      faults_in_words(faults, channel.measured, channel.unit),
      channel.is_refused ? ". Less than half is left: it is held against nothing" : ""));
  channel.measured = without(channel.measured, faults);
}

/// Says what was measured and not computed.
void doubt_snatches(const std::vector<FaultySamples>& snatches, const HeldChannel& channel,
                    std::vector<std::string>& doubts) {
  if (snatches.empty()) return;
  doubts.push_back(fmt::format(
      "{}: {} as of a rope that comes taut with a jerk, which was not computed: not "
      "left out",
      channel.name, leaps_in_words(snatches, "leap", "leaps", channel.measured, channel.unit)));
}

void doubt_load_changes(const std::vector<FaultySamples>& changes, const HeldChannel& channel,
                        std::vector<std::string>& doubts) {
  if (changes.empty()) return;
  doubts.push_back(fmt::format(
      "{}: {} for good, which other ropes share and which was not computed: the load or how it is "
      "shared changes. Not left out",
      channel.name, leaps_in_words(changes, "jump", "jumps", channel.measured, channel.unit)));
}

/// Puts every record on the clock of the lift and takes its channels over.
void take_record(const MeasuredRecord& record, const ResultsReader& results,
                 const std::optional<double>& given, MeasuredLift& lift) {
  std::vector<HeldChannel> channels;
  std::vector<ChannelToAlign> to_align;
  for (const MeasuredChannel& channel : record.channels) {
    if (is_surrounding(channel)) continue;
    HeldChannel held;
    held.name = channel.name;
    held.unit = channel.unit;
    held.measured = channel.series;
    held.computed = read_computed_channel(results, channel.name);
    if (held.computed.in_motion.size() < 2)
      refuse(record.file, fmt::format("the results have no values of \"{}\"", channel.name));
    to_align.push_back({{held.measured, held.computed.in_motion},
                        held.unit == "N",
                        held.name.substr(0, held.name.find('.'))});
    channels.push_back(std::move(held));
  }
  lift.doubts.insert(lift.doubts.end(), record.remarks.begin(), record.remarks.end());
  std::optional<AlignedChannels> aligned =
      align_channels(to_align, channels.empty() ? given.value_or(0) : given);
  if (!aligned)
    refuse(record.file,
           "nothing in this record or in what was computed of it moves, so that the "
           "two cannot be aligned",
           {"--shift says by how many seconds the clock of the lift is ahead of the record's"});
  lift.records.push_back(record_of(record, *aligned, given.has_value(), lift.doubts));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    HeldChannel& channel = channels[k];
    channel.measured = on_clock(std::move(channel.measured), aligned->clock);
    doubt_gaps(channel, lift.doubts);
    doubt_snatches(aligned->snatches[k], channel, lift.doubts);
    doubt_load_changes(aligned->load_changes[k], channel, lift.doubts);
    leave_out(aligned->faults[k], channel, lift.doubts);
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

void compare_channels(const TimeWindow& window, MeasuredLift& lift) {
  for (HeldChannel& channel : lift.channels) {
    if (channel.is_refused) continue;
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

void doubt_channels(const TimeWindow& window, MeasuredLift& lift) {
  for (HeldChannel& channel : lift.channels) {
    const std::string doubt = doubt_of(channel, window);
    channel.is_doubtful = channel.is_refused || !doubt.empty();
    if (!doubt.empty()) lift.doubts.push_back(channel.name + ' ' + doubt);
  }
}

void share_ropes(const TimeWindow& window, MeasuredLift& lift) {
  std::vector<HeldChannel*> ropes;
  std::vector<TimeSeries> measured;
  std::vector<TimeSeries> computed;
  for (HeldChannel& channel : lift.channels) {
    if (channel.name.rfind("ropes.", 0) != 0 || channel.is_refused) continue;
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
  std::vector<std::string> unknown;
  for (HeldChannel& channel : lift.channels) {
    if (channel.is_refused || known_share(channel.measured, window) < least_known_share) {
      unknown.push_back(channel.name);
      continue;
    }
    channel.measured_decay = fit_decay(samples_in(channel.measured, window));
    channel.computed_decay = fit_decay(samples_in(channel.computed.in_motion, window));
  }
  if (!unknown.empty())
    lift.doubts.push_back(fmt::format(
        "less than half of the time from {:g} s to {:g} s is known of {}: no oscillation is fitted",
        window.from, window.to, list_of_names(unknown)));
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

/// Of the time in which all ropes' records lie half must be known: what is left of a rest that is
/// full of faults may be no rest.
void refuse_little_rest(const std::map<std::string, TimeSeries>& tensions,
                        const std::vector<std::string>& ropes, const TimeWindow& window,
                        const std::string& place) {
  std::vector<TimeSeries> series;
  for (const std::string& rope : ropes) series.push_back(tensions.at(rope));
  const TimeWindow common = common_time(series, window);
  if (!(common.length() > 0)) return;  // said by the number of instants
  std::vector<std::string> unknown;
  for (std::size_t k = 0; k < ropes.size(); ++k)
    if (known_share(series[k], common) < least_known_share) unknown.push_back(ropes[k]);
  if (!unknown.empty())
    refuse(place, "the load cannot be weighed: less than half of the time is known of " +
                      list_of_names(unknown));
}

/// Why channels that are in a record count as not measured; empty where there are none.
std::string why_refused(const MeasuredLift& lift) {
  std::vector<std::string> refused;
  for (const HeldChannel& channel : lift.channels)
    if (channel.is_refused) refused.push_back(channel.name);
  if (refused.empty()) return {};
  return fmt::format("; less than half of the samples is credible of {}", list_of_names(refused));
}

void weigh_load(const ResultsReader& results, const MeasurementSettings& settings,
                MeasuredLift& lift) {
  const TimeWindow& window = *settings.rest;
  const std::string place = fmt::format("--rest {:g}:{:g}", window.from, window.to);
  const std::vector<std::string> ropes = ropes_at_load(results);
  if (ropes.empty()) refuse(place, "these results know of no rope at the load");
  std::map<std::string, TimeSeries> tensions;
  for (const HeldChannel& channel : lift.channels)
    if (!channel.is_refused) tensions[channel.name] = channel.measured;
  std::vector<std::string> missing;
  for (const std::string& rope : ropes)
    if (tensions.count(rope) == 0) missing.push_back(rope);
  if (!missing.empty())
    refuse(place, "the load cannot be weighed: not every rope at it was measured",
           {"what lacks is " + list_of_names(missing) + why_refused(lift)});
  if (has_unreadable_gravity(lift.result))
    refuse(place, "gravity stands in the case as an expression, which is not followed here",
           {"write it as a number with its unit"});
  const double gravity = input_quantity(lift.result, ".gravity", Dimension::acceleration)
                             .value_or(newton_per_tonne / 1000);
  const auto weighing =
      weigh(weighing_instants(results, tensions, window), gravity, settings.cell_accuracy);
  refuse_little_rest(tensions, ropes, window, place);
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
  compare_channels(window, lift);
  doubt_channels(window, lift);
  share_ropes(window, lift);
  if (settings.decay) identify_decays(*settings.decay, lift);
  if (settings.rest) weigh_load(results, settings, lift);
  return lift;
}

}  // namespace blocklift::pipeline
