#pragma once

#include <vector>

#include "dynamics/simulation/lift_system.h"
#include "pipeline/build/build_lift.h"

namespace blocklift::pipeline {

/// A history that a run is going to record: of an operation at rest, or in motion.
struct HistoryToCome {
  const dynamics::LiftSystem* system = nullptr;
  double interval = 0;      ///< between samples, s
  const char* key = "";     ///< of the input file that gives the interval
  bool with_works = false;  ///< of a motion: dynamics::EnergyHistory
  bool with_peaks = false;  ///< of a motion: a sample more a rope, dynamics::integrate_with_peaks
};

/// Samples of a history from the start of the operation to its end, dynamics::sample_times, and
/// those of peaks.
double sample_count(const HistoryToCome& history);

/// What dynamics::History holds of each sample, bytes, and the time of it that the run keeps.
double bytes_of_sample(const dynamics::LiftSystem& system, bool with_works);

/// Refuses histories that memory would not hold, before the first of them is begun.
/// @throws dynamics::SimulationError with what they need, what may be used
///   (structure::limit_memory, dynamics::usable_memory), and the keys that make it less.
void require_memory(const std::vector<HistoryToCome>& histories);
/// The same for both histories of a lift, at rest and in motion.
void require_memory(const LiftCase& lift_case, const BuiltLift& model);

}  // namespace blocklift::pipeline
