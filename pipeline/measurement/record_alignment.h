#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/measurement/credible_samples.h"
#include "pipeline/measurement/time_shift.h"

namespace blocklift::pipeline {

/// A channel of a record before it is on the clock of the lift.
struct ChannelToAlign {
  ChannelPair pair;
  bool is_tension = false;
  std::string kind = {};  ///< "ropes", "hoists": those of one kind hold the load together
};

/// A record's channels by the clock of the lift, with what is not credible told apart.
struct AlignedChannels {
  TimeShift clock;
  bool is_found = false;  ///< not given
  // Of each channel, among its own samples.
  std::vector<std::vector<FaultySamples>> faults;
  std::vector<std::vector<FaultySamples>> snatches;  ///< they were not computed
  std::vector<std::vector<FaultySamples>> load_changes;
};

/// Finds the clock of a record (find_time_shift) and the faults of its channels (find_faults),
/// which need each other: faults spoil a correlation, and are told from what happened by what was
/// computed at the same time. The clock is looked for with all samples, and, where these do not
/// follow the computed ones, without the suspects; then again without the faults.
/// @param given shift, s; none: it is to be found.
/// @returns none where it is to be found and nothing moves.
std::optional<AlignedChannels> align_channels(const std::vector<ChannelToAlign>& channels,
                                              const std::optional<double>& given);

}  // namespace blocklift::pipeline
