#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/measurement/time_series.h"

namespace blocklift::pipeline {

/// What a tension is when the load hangs, with its sign: a few spikes do not make it, nor do zeros.
/// @param values at least one.
double typical_load(const std::vector<double>& values);

/// A tension that was measured, by the clock of the lift, and the computed one. Neither is empty.
struct TensionPair {
  const TimeSeries* measured = nullptr;
  const TimeSeries* computed = nullptr;
};

/// Tells a load that changes for good from another zero of one cell, by the other ropes:
///   - they take over what the rope loses, or lose what it takes: their jumps and its own add up to
///     less than half of its own (slings lean, so that they need not add up to nothing), or
///   - all jump to the same share of what they bore, within a quarter of it: the load itself is
///     another. To a tenth of it or less all may have been set to zero.
/// A jump is that of medians of 20 samples on each side, of measured less computed.
/// @param own the rope whose tension jumps. @param jump its first sample behind the jump.
/// @param others all other tensions of its kind that were measured.
bool is_load_change(const TensionPair& own, std::size_t jump,
                    const std::vector<TensionPair>& others);

}  // namespace blocklift::pipeline
