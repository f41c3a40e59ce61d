#pragma once

#include <optional>
#include <vector>

#include "pipeline/lift/history_assessment.h"
#include "pipeline/lift/stage_loads.h"

namespace blocklift::pipeline {

/// Largest checked stress of the block within a stage of the operation.
struct StageStress : StageSpan {
  HistoryExtreme at_rest, in_motion;  ///< Pa; the rope is not looked up
  /// By which motion raises it; none where the block at rest has less than a hundredth of the
  /// lift's largest stress at rest, as when it stands on its supports.
  std::optional<double> increase_percent;
};

/// The block stage by stage, so that one phase does not hide another: a blow while the slings
/// tighten says nothing of how the block fares on the hook. Stages in which no sample lies are left
/// out.
std::vector<StageStress> find_stage_stresses(const std::vector<StageSpan>& stages,
                                             const structure::UnitResponses& responses,
                                             const structure::StressRecovery& recovery,
                                             const HistoryAssessment& history);

}  // namespace blocklift::pipeline
