#pragma once

#include <vector>

#include "pipeline/measures/measure.h"

namespace blocklift::pipeline {

/// Does the hoist's block turn against its falls?
bool block_turns(const LiftRun& lift, const LiftHoist& hoist);

/// Twist of the falls of a block that turns at each sample, rad, positive anticlockwise seen from
/// above, without jumps of a whole turn.
Eigen::VectorXd falls_twist(const LiftRun& lift, const LiftHoist& hoist,
                            const dynamics::History& history);

/// For each block that turns: twist and moment of its falls, and with a bearing how far the hook
/// has turned on it.
void add_hook_block_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures);

}  // namespace blocklift::pipeline
