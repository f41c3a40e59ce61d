#pragma once

#include <string>
#include <vector>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// Groups of bars of open section that torsion stresses most in a lift, at the instants of the
/// ropes' largest loads or under a load table: that such sections resist warping is not computed.
/// Each a sentence. Groups whose stress is below a tenth of their yield stress are passed over.
std::vector<std::string> list_torsion_doubts(const BlockRun& block);

}  // namespace blocklift::pipeline
