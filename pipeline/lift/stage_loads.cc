#include "pipeline/lift/stage_loads.h"

#include <algorithm>
#include <functional>

#include "pipeline/lift/sling_ends.h"

namespace blocklift::pipeline {

namespace {

/// The largest values of a series within a stage.
class StageMaxima {
 public:
  StageMaxima(const LiftRun& lift, const StageSpan& stage)
      : at_rest_(lift.static_history),
        in_motion_(lift.dynamic_history()),
        still_(samples_within(stage, at_rest_.time)),
        moving_(samples_within(stage, in_motion_.time)) {}

  bool has_samples() const { return still_.count > 0 && moving_.count > 0; }

  StageLoad of(const std::string& name,
               const std::function<Eigen::VectorXd(const dynamics::History&)>& series) const {
    StageLoad load;
    load.name = name;
    Eigen::Index still = 0, moving = 0;
    load.at_rest = series(at_rest_).segment(still_.first, still_.count).maxCoeff(&still);
    load.in_motion = series(in_motion_).segment(moving_.first, moving_.count).maxCoeff(&moving);
    load.time_at_rest = at_rest_.time[still_.first + still];
    load.time_in_motion = in_motion_.time[moving_.first + moving];
    return load;
  }

  StageLoad of_rope(const std::string& name, int rope) const {
    return of(name,
              [rope](const dynamics::History& history) { return history.ropes[rope].tension; });
  }

 private:
  const dynamics::History& at_rest_;
  const dynamics::History& in_motion_;
  SampleSpan still_, moving_;
};

}  // namespace

SampleSpan samples_within(const StageSpan& stage, const Eigen::VectorXd& time) {
  // Samples at the ends belong to the stage in spite of rounding.
  constexpr double rounding = 1e-6;  // s
  const double* const begin = time.data();
  const double* const end = begin + time.size();
  const double* const first = std::lower_bound(begin, end, stage.start - rounding);
  const double* const last = std::upper_bound(begin, end, stage.end + rounding);
  return {first - begin, last - first};
}

std::vector<StageSpan> find_stage_spans(const LiftRun& lift) {
  std::vector<StageSpan> spans;
  const auto& stages = lift.model.system.operation().stages();
  double start = 0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double end = i + 1 < stages.size() ? stages[i].end : lift.simulated_s();
    const auto& stop = lift.model.schedule.stages[i].stop;
    spans.push_back({stages[i].name, start, end, stop ? std::optional(stop->met) : std::nullopt});
    start = end;
  }
  return spans;
}

std::vector<StageLoads> find_stage_loads(const LiftRun& lift) {
  std::vector<StageLoads> all;
  for (const StageSpan& stage : find_stage_spans(lift)) {
    const StageMaxima maxima(lift, stage);
    if (!maxima.has_samples()) continue;
    StageLoads& loads = all.emplace_back();
    static_cast<StageSpan&>(loads) = stage;
    for (const LiftRope& rope : lift.model.ropes)
      loads.ropes.push_back(maxima.of_rope(rope.name, rope.rope));
    for (const LiftHoist& hoist : lift.model.hoists)
      loads.hoists.push_back(maxima.of_rope(hoist.name, hoist.rope));
    loads.load = maxima.of("load", [&](const dynamics::History& history) {
      return load_on_slings(lift.model, history);
    });
  }
  return all;
}

}  // namespace blocklift::pipeline
