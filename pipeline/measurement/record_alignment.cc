#include "pipeline/measurement/record_alignment.h"

#include <algorithm>
#include <utility>

namespace blocklift::pipeline {
namespace {

using FaultsOfChannels = std::vector<std::vector<FaultySamples>>;

bool is_any(const FaultsOfChannels& faults) {
  return std::any_of(faults.begin(), faults.end(), [](const auto& one) { return !one.empty(); });
}

/// The clock by the samples that are left; a channel of which hardly any are left keeps all of
/// them.
std::optional<TimeShift> clock_without(const std::vector<ChannelToAlign>& channels,
                                       const FaultsOfChannels& faults) {
  std::vector<ChannelPair> pairs;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    pairs.push_back(channels[k].pair);
    const std::size_t size = pairs.back().measured.size();
    if (4 * count_left_out(faults[k], size) <= 3 * size)
      pairs.back().measured = without(pairs.back().measured, faults[k]);
  }
  return find_time_shift(pairs);
}

/// Faults are looked for by the record alone at first: the fewer samples that takes away, the
/// sooner it is believed.
std::optional<TimeShift> clock_by_itself(const std::vector<ChannelToAlign>& channels) {
  constexpr double follows = 0.95, clearly = 0.05;
  const FaultsOfChannels none(channels.size());
  FaultsOfChannels excursions(channels.size()), all(channels.size());
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const TimeSeries& measured = channels[k].pair.measured;
    all[k] = suspects_as_faults(find_suspects(measured, channels[k].is_tension), measured.size());
    std::copy_if(all[k].begin(), all[k].end(), std::back_inserter(excursions[k]),
                 [](const FaultySamples& one) {
                   return one.fault == Fault::spike || one.fault == Fault::drop_out;
                 });
  }
  std::optional<TimeShift> best = clock_without(channels, none);
  for (const FaultsOfChannels* suspects : {&excursions, &all}) {
    if ((best && best->correlation >= follows) || !is_any(*suspects)) continue;
    const std::optional<TimeShift> other = clock_without(channels, *suspects);
    if (other && (!best || other->correlation > best->correlation + clearly)) best = other;
  }
  return best;
}

/// Finds the faults by a clock, and what is none but was not computed.
void judge_on_clock(const std::vector<ChannelToAlign>& channels, AlignedChannels& aligned) {
  aligned.faults.clear();
  aligned.snatches.clear();
  aligned.load_changes.clear();
  std::vector<TimeSeries> measured;
  for (const ChannelToAlign& channel : channels)
    measured.push_back(on_clock(channel.pair.measured, aligned.clock));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    std::vector<TensionPair> others;
    for (std::size_t other = 0; other < channels.size(); ++other)
      if (other != k && channels[k].is_tension && channels[other].is_tension &&
          channels[other].kind == channels[k].kind)
        others.push_back({&measured[other], &channels[other].pair.computed});
    JudgedSamples judged =
        judge_samples(measured[k], channels[k].pair.computed, channels[k].is_tension, others);
    aligned.faults.push_back(std::move(judged.faults));
    aligned.snatches.push_back(std::move(judged.snatches));
    aligned.load_changes.push_back(std::move(judged.load_changes));
  }
}

}  // namespace

std::optional<AlignedChannels> align_channels(const std::vector<ChannelToAlign>& channels,
                                              const std::optional<double>& given) {
  AlignedChannels aligned;
  aligned.clock.shift = given.value_or(0);
  if (!given) {
    const std::optional<TimeShift> found = clock_by_itself(channels);
    if (!found) return std::nullopt;
    aligned.clock = *found;
    aligned.is_found = true;
  }
  judge_on_clock(channels, aligned);
  if (given || !is_any(aligned.faults)) return aligned;
  if (const std::optional<TimeShift> again = clock_without(channels, aligned.faults)) {
    aligned.clock = *again;
    judge_on_clock(channels, aligned);
  }
  return aligned;
}

}  // namespace blocklift::pipeline
