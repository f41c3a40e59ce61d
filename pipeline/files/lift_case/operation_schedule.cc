#include "pipeline/files/lift_case/operation_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/files/lift_case/drive_dimensions.h"

namespace blocklift::pipeline {
namespace {

/// Is this a drive that exists but could not be read (or whose crane could not)?
bool is_incomplete(const LiftCase& lift_case, const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) {
    const given::Rope* rope = lift_case.find_rope(name);
    return rope && rope->winch;
  }
  const given::Crane* crane = lift_case.find_crane(name.substr(0, dot));
  if (!crane) return false;
  if (!crane->model) return true;
  const std::string part = name.substr(dot + 1);
  return crane->model->find_drive(part) || crane->model->find_hoist(part);
}

}  // namespace

void add_mover(std::vector<Mover>& movers, std::string name, bool is_winch,
               const DriveLimits& limits, const Quantity& start_value) {
  const double start = start_value.value;
  Mover mover;
  mover.name = std::move(name);
  mover.is_winch = is_winch;
  mover.travel = limits.range[0].dimension;
  mover.limits = {limits.speed.value.value, limits.acceleration.value.value,
                  limits.jerk.value.value};
  mover.lowest = limits.range[0].value;
  mover.highest = limits.range[1].value;
  mover.start = start;
  const bool complete = std::isfinite(mover.limits.speed + mover.limits.acceleration +
                                      mover.limits.jerk + mover.lowest + mover.highest + start);
  const bool of_one_kind = start_value.dimension == mover.travel &&
                           limits.range[1].dimension == mover.travel &&
                           limits.speed.value.dimension == speed_of(mover.travel) &&
                           limits.acceleration.value.dimension == acceleration_of(mover.travel);
  if (complete && of_one_kind) movers.push_back(std::move(mover));
}

std::vector<Mover> movers_of(const LiftCase& lift_case) {
  std::vector<Mover> movers;
  for (const given::Crane& crane : lift_case.cranes) {
    if (!crane.model) continue;
    const auto start_of = [&](const std::string& part) {
      const Located<Quantity>* start = crane.find_start(part);
      return start ? start->value : Quantity{};
    };
    for (const DriveModel& drive : crane.model->drives) {
      add_mover(movers, crane.name.value + "." + drive.name.value, false, drive,
                start_of(drive.name.value));
    }
    for (const HoistModel& hoist : crane.model->hoists) {
      add_mover(movers, crane.name.value + "." + hoist.name.value, true, hoist.winch,
                start_of(hoist.name.value));
    }
  }
  for (const given::Rope& rope : lift_case.ropes) {
    if (rope.winch) {
      add_mover(movers, rope.name.value, true, *rope.winch, {rope.length.value, Dimension::length});
    }
  }
  return movers;
}

Schedule schedule_operation(const LiftCase& lift_case, Diagnostics& diagnostics,
                            const FoundMotion& found) {
  return schedule_operation(
      {"the case", movers_of(lift_case), &lift_case.operation, lift_case.settle,
       [&](const std::string& name) { return is_incomplete(lift_case, name); }, found},
      diagnostics);
}

std::optional<std::size_t> Schedule::waiting_stage() const {
  for (std::size_t i = 0; i < stages.size(); ++i)
    if (stages[i].limit && !stages[i].stop) return i;
  return std::nullopt;
}

std::optional<std::size_t> Schedule::steered_stage() const {
  for (const ScheduledSteering& steered : steerings)
    if (!steered.course) return steered.stage;
  return std::nullopt;
}

std::size_t Schedule::last_known_stage() const {
  std::size_t end = stages.size();
  if (const auto waiting = waiting_stage()) end = std::min(end, *waiting);
  if (provisional_from) end = std::min(end, *provisional_from);
  return end - 1;
}

void add_schedule(const Schedule& schedule, dynamics::OperationBuilder& builder) {
  for (std::size_t i = 0; i < schedule.stages.size(); ++i) {
    const ScheduledStage& stage = schedule.stages[i];
    builder.add_stage(stage.name, stage.start, stage.end);
    for (const ScheduledMove& move : schedule.moves)
      if (move.stage == i) builder.add_move(schedule.movers[move.mover].name, move.move);
    for (const ScheduledFollower& follower : schedule.followers) {
      if (follower.stage != i) continue;
      double moves_end = stage.end;
      for (const ScheduledMove& move : schedule.moves)
        if (move.stage == i) moves_end = std::max(moves_end, move.move.end());
      builder.add_follower(schedule.movers[follower.mover].name,
                           schedule.movers[follower.leader].name, stage.start, moves_end,
                           follower.own_travel_over_leaders);
    }
    if (stage.stop) builder.stop_moves(stage.start, stage.stop->time, stage.stop->duration);
  }
  for (const ScheduledSteering& steered : schedule.steerings) {
    if (steered.course)
      builder.add_course(steered.steering.drive, *steered.course, steered.steering.stand());
  }
}

}  // namespace blocklift::pipeline
