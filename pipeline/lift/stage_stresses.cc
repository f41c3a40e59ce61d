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
    const double at_rest = stress.at_rest.at.value;
    if (at_rest > 0 && at_rest >= 0.01 * history.static_state.checked_von_mises.at.value)
      stress.increase_percent = percent_above(stress.in_motion.at.value, at_rest);
  }
  return all;
}

}  // namespace blocklift::pipeline
