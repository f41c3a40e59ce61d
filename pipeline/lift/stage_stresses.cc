#include "pipeline/lift/stage_stresses.h"

#include "structure/envelope/span_maximum.h"

namespace blocklift::pipeline {

namespace {

HistoryExtreme largest_within(const SampleSpan& span, const structure::UnitResponses& responses,
                              const structure::StressRecovery& recovery,
                              const HistoryState& state) {
  HistoryExtreme extreme;
  extreme.at = structure::find_largest_in_span(responses, recovery,
                                               state.factors.middleCols(span.first, span.count),
                                               state.square_von_mises);
  if (extreme.at.instant < 0) return extreme;
  extreme.at.instant += static_cast<int>(span.first);
  extreme.time = state.time[extreme.at.instant];
  return extreme;
}

}  // namespace

std::optional<double> StageStress::increase_percent() const {
  if (at_rest.at.value < 0.01 * in_motion.at.value) return std::nullopt;
  return percent_above(in_motion.at.value, at_rest.at.value);
}

std::vector<StageStress> find_stage_stresses(const std::vector<StageSpan>& stages,
                                             const structure::UnitResponses& responses,
                                             const structure::StressRecovery& recovery,
                                             const HistoryAssessment& history) {
  std::vector<StageStress> all;
  for (const StageSpan& stage : stages) {
    const SampleSpan still = samples_within(stage, history.static_state.time);
    const SampleSpan moving = samples_within(stage, history.dynamic_state.time);
    if (still.count == 0 || moving.count == 0) continue;
    StageStress& stress = all.emplace_back();
    static_cast<StageSpan&>(stress) = stage;
    stress.at_rest = largest_within(still, responses, recovery, history.static_state);
    stress.in_motion = largest_within(moving, responses, recovery, history.dynamic_state);
  }
  return all;
}

}  // namespace blocklift::pipeline
