#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/measurement/credible_samples.h"

namespace blocklift::pipeline {

/// Tells snatches of a rope from what a cell or its line does, by the record alone. A leap to a
/// larger tension is a snatch where
///   - the rope was slack before it and bears behind it, and had not leapt to its zero, as a line
///     does that breaks, or
///   - the load dances on the rope behind it: tensions lie on both sides of their median by turns,
///     farther than they do elsewhere, and less and less (what an amplifier has swallowed comes
///     back from one side).
/// Leaps that follow a snatch while the load dances belong to it, but for one that stands off
/// more than twice as far as all about it: a spike. One half as high again as the leap before it
/// is a snatch of its own or a spike.
class Snatches {
 public:
  /// @param limit the shortest leap, in the series' unit.
  Snatches(const std::vector<double>& values, double limit);

  /// Of spikes and drop-outs, those that are snatches.
  std::vector<FaultySamples> among(const std::vector<FaultySamples>& leaps) const;

 private:
  bool is_snatch(const FaultySamples& one) const;
  bool belongs_to(const FaultySamples& snatch, const FaultySamples& one) const;
  /// Do samples [begin, end) stand off far more than those beside them?
  bool is_alone(std::size_t begin, std::size_t end) const;
  bool comes_taut(const FaultySamples& one) const;
  bool dances_behind(const FaultySamples& one) const;
  double stand_off(std::size_t i) const;
  double median_behind(std::size_t i) const;

  const std::vector<double>& values_;
  double limit_;
  double load_ = 0;   ///< what the rope carries mostly, with its sign
  double usual_ = 0;  ///< how far 19 of 20 samples lie from the median about them at most
};

}  // namespace blocklift::pipeline
