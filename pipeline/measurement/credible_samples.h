#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/measurement/load_changes.h"
#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// What may have gone wrong with a cell or its line.
enum class Fault {
  spike,     ///< up to three samples stand off from their neighbours
  drop_out,  ///< more of them, entered and left by leaps: zeros, most often
  stuck,     ///< one value again and again
  restart    ///< all on one side of a jump, as of a cell that has another zero since
};

/// Samples [begin, end) of a series.
struct FaultySamples {
  Fault fault = Fault::spike;
  std::size_t begin = 0;
  std::size_t end = 0;  ///< `begin` itself of a jump whose sides have not been chosen between
  double leap = 0;      ///< how far they stand off, or how far the jump is, in the series' unit
};

/// What of a series may be faults, by itself alone: leaps ten times as far as 19 of 20 steps
/// between samples and as a twentieth of the largest load (of other quantities: half of their
/// range); eight or more equal samples where hardly any two others are equal, or with a leap
/// beside them. Spikes stand off from the median of seven samples (Hampel 1974).
std::vector<FaultySamples> find_suspects(const TimeSeries& series, bool is_tension);

/// Suspects that the computed quantity does not share.
struct JudgedSamples {
  std::vector<FaultySamples> faults;
  /// Leaps that are snatches of the rope (snatches.h) which were not computed: no faults.
  std::vector<FaultySamples> snatches = {};
  /// Jumps of a load that the other ropes share (load_changes.h) and that were not computed: none
  /// either.
  std::vector<FaultySamples> load_changes = {};
};

/// Those suspects that the computed quantity does not share: it does not move so about them, or
/// moves on where the measured one stands still, but for a tension near zero that is reached and
/// left without a leap: such a rope is slack. Of jumps the longest stretch between two stays,
/// and the others are faults as a whole: which zero is right nobody has measured. A jump that the
/// computed quantity makes at another time is none: between the beginning of the stretch before it
/// and the end of the one behind it both have gone as far.
/// @param measured by the clock of the lift. @param computed not empty.
/// @param others of a tension: what else was measured of its kind, ropes or hoists.
JudgedSamples judge_samples(const TimeSeries& measured, const TimeSeries& computed, bool is_tension,
                            const std::vector<TensionPair>& others = {});
/// The faults alone.
std::vector<FaultySamples> find_faults(const TimeSeries& measured, const TimeSeries& computed,
                                       bool is_tension);

/// All of the suspects as if they were faults.
std::vector<FaultySamples> suspects_as_faults(std::vector<FaultySamples> suspects,
                                              std::size_t size);

/// A series without some of its samples, between which nothing is known then.
TimeSeries without(const TimeSeries& series, const std::vector<FaultySamples>& faults);

/// How many samples that leaves out; those of two faults count once.
std::size_t count_left_out(const std::vector<FaultySamples>& faults, std::size_t size);

/// "2 spikes, the farthest of +48 kN at 20.0 s; it leaps away and back from 30.0 s to 34.9 s".
/// @param unit SI, of the series.
std::string faults_in_words(const std::vector<FaultySamples>& faults, const TimeSeries& series,
                            const std::string& unit);
/// "a snatch of +48 kN at 20.0 s", "3 snatches, the farthest of +48 kN at 20.0 s".
/// @param leaps at least one.
std::string leaps_in_words(const std::vector<FaultySamples>& leaps, const std::string& name,
                           const std::string& plural, const TimeSeries& series,
                           const std::string& unit);

}  // namespace blocklift::pipeline
