#include "pipeline/lift/stage_end.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/build/held_heading.h"

namespace blocklift::pipeline {

namespace {

using Kind = dynamics::AwaitedCondition::Kind;

dynamics::AwaitedCondition condition_of(const StageUntil& until, const LiftCase& lift_case,
                                        const BuiltLift& model) {
  dynamics::AwaitedCondition awaited;
  awaited.body = model.load;
  const double weight = model.system.mechanism().body(model.load).inertia.mass * lift_case.gravity;
  const auto pull = [&](Kind kind, const std::string& rope) {
    awaited.kind = kind;
    awaited.rope = find_rope(model.ropes, model.hoists, rope);
  };
  const auto bear = [&](Kind kind, double share) {
    awaited.kind = kind;
    awaited.force = share * weight;
  };
  if (until.slack) pull(Kind::slack, until.slack->value);
  if (until.taut) pull(Kind::taut, until.taut->value);
  if (until.ropes_at_least) bear(Kind::ropes_at_least, until.ropes_at_least->value);
  if (until.ropes_at_most) bear(Kind::ropes_at_most, until.ropes_at_most->value);
  if (until.ground_at_least) bear(Kind::pads_at_least, until.ground_at_least->value);
  return awaited;
}

std::string in_words(const StageUntil& until) {
  const auto percent = [](double share) { return fmt::format("{:g} % of the load", 100 * share); };
  if (until.slack) return until.slack->value + " to go slack";
  if (until.taut) return until.taut->value + " to pull";
  if (until.ropes_at_least)
    return "ropes to bear " + percent(until.ropes_at_least->value) + " or more";
  if (until.ropes_at_most)
    return "ropes to bear " + percent(until.ropes_at_most->value) + " or less";
  return "the ground to bear " + percent(until.ground_at_least->value) + " or more";
}

/// Integrates the operation from rest up to a time (s) that is set by `end_by`.
template <class EndBy>
dynamics::IntegrationResult run_up_to(const LiftCase& lift_case, const BuiltLift& model,
                                      const std::string& what, double end, const Progress& progress,
                                      const EndBy& end_by) {
  const dynamics::LiftSystem& system = model.system;
  Eigen::VectorXd q = system.q_start();
  solver_at_rest(model).solve(0, q);
  dynamics::IntegrationSettings settings;
  settings.relative_tolerance = lift_case.dynamics.relative_tolerance;
  settings.sample_interval = lift_case.dynamics.sample_interval;
  // What happened on the way up to there nobody asks for.
  settings.works = false;
  settings.recording = dynamics::Recording::tensions();
  settings.surface = model.marched.radiation.get();
  settings.surface_step = model.marched.step;
  settings.progress = [&](double, double time) {
    progress(what, time / end, fmt::format("t = {:.0f} s", time));
  };
  end_by(settings);
  return dynamics::integrate(system, q, Eigen::VectorXd::Zero(system.mechanism().nv()), settings);
}

}  // namespace

std::vector<dynamics::Course> find_courses(const LiftCase& lift_case, const BuiltLift& model,
                                           const Progress& progress) {
  const Schedule& schedule = model.schedule;
  const std::size_t last = schedule.last_known_stage();
  const double end = schedule.stages[last].end;
  dynamics::IntegrationResult result =
      run_up_to(lift_case, model, "steered drives", end, progress,
                [&](dynamics::IntegrationSettings& settings) { settings.end = end; });
  // Drives of later stages are steered in the model, too, after those of these.
  const auto count =
      std::count_if(schedule.steerings.begin(), schedule.steerings.end(),
                    [&](const ScheduledSteering& one) { return !one.course && one.stage <= last; });
  result.courses.resize(count);
  return std::move(result.courses);
}

double find_stage_end(const LiftCase& lift_case, const BuiltLift& model, std::size_t stage,
                      const Progress& progress) {
  const StageUntil& until = *lift_case.operation[stage].until;
  const ScheduledStage& scheduled = model.schedule.stages[stage];
  const dynamics::IntegrationResult result =
      run_up_to(lift_case, model, "end of stage " + scheduled.name, *scheduled.limit, progress,
                [&](dynamics::IntegrationSettings& settings) {
                  settings.awaited = condition_of(until, lift_case, model);
                  settings.awaited->from = scheduled.start;
                  settings.awaited->until = *scheduled.limit;
                });
  if (result.met) return *result.met;
  throw dynamics::SimulationError(fmt::format(
      "stage \"{}\" waits for {}, which has not come about at {:.6g} s, {:.6g} s after its "
      "beginning; let its moves go further, or give it more time (within)",
      scheduled.name, in_words(until), *scheduled.limit, *scheduled.limit - scheduled.start));
}

}  // namespace blocklift::pipeline
