#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/files/rigging/spreader.h"
#include "pipeline/standards/rigging_balance.h"

namespace blocklift::pipeline {

/// By how much frames give way along the ropes that end at them, ropes x ropes, m/N: the pull of a
/// rope moves the ends of all by structure::RectangularFrame::flexibility, in the frame's plane and
/// out of it. Bars are rigid.
/// @param spreaders by their places in `rigging.bars`.
Eigen::MatrixXd compliance_of_frames(const TolerancedRigging& rigging,
                                     const std::vector<const given::Spreader*>& spreaders);

/// The balance of a rigging with what its load and those frames give way.
RiggingBalance balance_of(const TolerancedRigging& rigging,
                          const std::vector<const given::Spreader*>& spreaders);

}  // namespace blocklift::pipeline
