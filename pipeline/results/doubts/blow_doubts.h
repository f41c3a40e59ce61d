#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// A rope that went slack and snatched before another, or the same, had its largest load. Another's
/// counts if the load hangs by it: a mooring's snatch is its own.
struct Blow {
  int rope = -1;          ///< the one that snatched, among the system's
  double slack_from = 0;  ///< s
  double taut_again = 0;  ///< s
};

/// So long a blow is taken to rule a largest load that follows it, and so long a rope may be slack
/// for its return to be a blow, s. A load that bounces on its ropes with a period of 1 s and 2 % of
/// the critical damping still has exp(-0.04 pi 10) = 28 % of its motion then.
inline constexpr double reach_of_blow = 10;

/// The last blow before a rope's largest tension in motion, within reach_of_blow. None where that
/// tension is at most 5 % above the largest at rest, which it is without a blow, too; without a
/// sweep at rest any tension counts. Ropes that were slack from the start and are taken up have
/// given no blow.
std::optional<Blow> find_blow_before_peak(const LiftRun& lift, int rope);

/// Largest loads of ropes and hoists that follow a blow: one sentence of them all, or none. A
/// slightly different run has others, which may be larger.
std::vector<std::string> list_blow_doubts(const LiftRun& lift);

}  // namespace blocklift::pipeline
