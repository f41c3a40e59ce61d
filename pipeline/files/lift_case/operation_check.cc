#include "pipeline/files/lift_case/operation_check.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "pipeline/files/lift_case/case_names.h"
#include "pipeline/files/lift_case/operation_schedule.h"

namespace blocklift::pipeline {
namespace {

/// The operation takes time, and no more samples of it are asked for than a machine holds.
void check_duration(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics) {
  constexpr double most_samples = 5e5;  // some 10 kB each
  if (lift_case.operation.empty() || diagnostics.has_errors()) return;
  if (!(schedule.duration > 0)) {
    diagnostics.error(lift_case.operation.front().name.mark, "the operation takes no time",
                      {"give it a move, a pause or a settle time"});
    return;
  }
  const auto check = [&](const char* key, double interval) {
    if (schedule.duration <= most_samples * interval) return;
    diagnostics.error(
        lift_case.operation.front().name.mark,
        fmt::format("the operation lasts {:.6g} s, with a sample every {:g} s ({})",
                    schedule.duration, interval, key),
        {fmt::format("at most {:.0f} samples are recorded; shorten the pauses or lengthen the "
                     "interval",
                     most_samples)});
  };
  check("sample_interval", lift_case.dynamics.sample_interval);
  check("static_interval", lift_case.dynamics.static_interval);
}

/// Faults name what is there, once, while the operation lasts.
class FaultCheck {
 public:
  FaultCheck(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        // Of an operation with mistakes nobody knows how long it lasts.
        duration_(diagnostics.has_errors() ? 0 : schedule.duration) {
    for (const given::Rope& rope : lift_case.ropes) ropes_.push_back(rope.name.value);
    for (const given::Crane& crane : lift_case.cranes) {
      if (!crane.model) continue;
      for (const HoistModel& hoist : crane.model->hoists)
        ropes_.push_back(crane.name.value + "." + hoist.name.value);
    }
    for (const Mover& mover : schedule.movers) {
      drives_.push_back(mover.name);
      if (mover.is_winch) winches_.push_back(mover.name);
    }
    drives_.emplace_back("all");
  }

  void check(const given::Fault& fault) {
    check_instant(fault);
    for (const Located<std::string>& rope : fault.parts)
      check_name(rope, ropes_, "parts", "its ropes and hoists are", parted_);
    for (const Located<std::string>& drive : fault.stops)
      check_name(drive, drives_, "stops", "its drives and winches are", stopped_);
    for (const Located<std::string>& winch : fault.runs_away)
      check_name(winch, winches_, "runs away with", "its winches are", stopped_);
    const bool told = fault.speed && fault.caught_after;
    const bool nothing_told = !fault.speed && !fault.caught_after;
    if (fault.runs_away.empty() ? !nothing_told : !told)
      diagnostics_.error(fault.place,
                         fault.runs_away.empty()
                             ? "the fault has a speed or caught_after, and no winch that runs away"
                             : "a winch runs away, and the fault lacks its speed or caught_after",
                         {"for example: {at: 60 s, runs_away: [C1.main], speed: 20 m/min, "
                          "caught_after: 2 s}"});
  }

 private:
  void check_instant(const given::Fault& fault) {
    const bool sought = !fault.worst_for.empty();
    if (fault.at.has_value() == sought)
      diagnostics_.error(fault.place,
                         sought ? "the fault has both an instant and worst_for"
                                : "the fault does not say when it comes",
                         {"give at, an instant, or worst_for: [all], the worst one"});
    if (!sought && (fault.from || fault.to))
      diagnostics_.error(fault.place, "from and to go with worst_for, which is not there");
    if (fault.from && fault.to && !(fault.from->value < fault.to->value))
      diagnostics_.error(fault.to->mark, "the worst instant is sought until before it is sought");
    for (const auto& at : {fault.at, fault.from}) {
      if (duration_ > 0 && at && at->value > duration_)
        diagnostics_.error(
            at->mark,
            fmt::format("the fault comes at {:g} s, after the end of the operation", at->value),
            {fmt::format("the operation lasts {:g} s", duration_)});
    }
    if (!sought) return;
    if (any_sought_)
      diagnostics_.error(fault.worst_for.front().mark,
                         "the worst instant is sought for one fault at a time",
                         {"give the other its instant (at), or a case of its own"});
    any_sought_ = true;
    std::vector<std::string> known = ropes_;
    known.emplace_back("all");
    std::set<std::string> before;
    for (const Located<std::string>& rope : fault.worst_for)
      check_name(rope, known, "is worst for", "its ropes and hoists are", before);
  }

  void check_name(const Located<std::string>& name, const std::vector<std::string>& known,
                  const char* verb, const char* hint, std::set<std::string>& before) {
    if (std::find(known.begin(), known.end(), name.value) == known.end()) {
      diagnostics_.error(
          name.mark,
          fmt::format("the fault {} \"{}\", which the case does not have", verb, name.value),
          {names_hint(hint, known, name.value)});
    } else if (!before.insert(name.value).second || (before.contains("all") && before.size() > 1)) {
      diagnostics_.error(name.mark, fmt::format("\"{}\" {} twice", name.value, verb));
    }
  }

  Diagnostics& diagnostics_;
  double duration_;
  std::vector<std::string> ropes_, drives_, winches_;
  std::set<std::string> parted_, stopped_;
  bool any_sought_ = false;
};

/// A head is moved by drives of its own crane.
void check_head(const std::optional<Located<std::string>>& head, const Mover& mover,
                Diagnostics& diagnostics) {
  if (mover.is_winch || !head || before_dot(head->value) == before_dot(mover.name)) return;
  diagnostics.error(head->mark, fmt::format("{} is on crane {}, and {} does not move it",
                                            head->value, before_dot(head->value), mover.name));
}

/// What a law sees is there, and can be seen from its drive.
void check_sights(const given::Keep& keep, const Mover& mover,
                  const std::vector<std::string>& ropes, Diagnostics& diagnostics) {
  const auto check_rope = [&](const Located<std::string>& rope) {
    if (std::find(ropes.begin(), ropes.end(), rope.value) == ropes.end())
      diagnostics.error(
          rope.mark,
          fmt::format("a law sees the pull of \"{}\", which is no rope or hoist of the case",
                      rope.value),
          {names_hint("its ropes and hoists are", ropes, rope.value)});
  };
  for (const given::Sight& sight : keep.sees) {
    if (sight.pull) check_rope(*sight.pull);
    if (sight.share) check_rope(*sight.share);
    for (const Located<std::string>& rope : sight.of) {
      check_rope(rope);
      if (sight.share && rope.value == sight.share->value)
        diagnostics.error(rope.mark, fmt::format("{} shares with itself", rope.value),
                          {"of: names the others"});
    }
    check_head(sight.head, mover, diagnostics);
    if (sight.head && mover.is_winch)
      diagnostics.error(sight.head->mark,
                        fmt::format("{} is a winch and moves no head over a point", mover.name),
                        {"heads are moved by drives of joints: trolley, travel, slewing, luffing"});
  }
}

/// What operators keep is kept by drives that can: winches heights and pulls, joints a plumb.
void check_keeping(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics) {
  const std::vector<std::string> ropes = names_of_ropes(lift_case);
  if (ropes.empty()) return;
  for (const ScheduledSteering& steering : schedule.steerings) {
    const given::Keep& keep = steering.keep;
    const Mover& mover = schedule.movers[steering.mover];
    check_sights(keep, mover, ropes, diagnostics);
    if (keep.law) continue;
    if (mover.is_winch == keep.over.has_value())
      diagnostics.error(
          steering.mark,
          mover.is_winch ? fmt::format("{} is a winch and keeps no head over a point", mover.name)
                         : fmt::format("{} is no winch and keeps no height or pull", mover.name),
          {"winches keep level, tension or share; drives of joints keep a head over "
           "a point"});
    check_head(keep.head, mover, diagnostics);
    for (const Located<std::string>& rope : keep.of) {
      if (std::find(ropes.begin(), ropes.end(), rope.value) == ropes.end())
        diagnostics.error(
            rope.mark,
            fmt::format("a share is kept of \"{}\", which is no rope or hoist of the case",
                        rope.value),
            {names_hint("its ropes and hoists are", ropes, rope.value)});
      if (rope.value == mover.name)
        diagnostics.error(rope.mark, fmt::format("{} shares with itself", rope.value),
                          {"of: names the others"});
    }
  }
}

/// Conditions that end stages name ropes that are there, and ground that bears.
void check_conditions(const LiftCase& lift_case, Diagnostics& diagnostics) {
  const std::vector<std::string> ropes = names_of_ropes(lift_case);
  if (ropes.empty()) return;
  for (const given::Stage& stage : lift_case.operation) {
    if (!stage.until) continue;
    for (const auto& rope : {stage.until->slack, stage.until->taut}) {
      if (!rope || std::find(ropes.begin(), ropes.end(), rope->value) != ropes.end()) continue;
      diagnostics.error(rope->mark,
                        fmt::format("stage \"{}\" waits for \"{}\", which is no rope or hoist of "
                                    "the case",
                                    stage.name.value, rope->value),
                        {names_hint("its ropes and hoists are", ropes, rope->value)});
    }
    if (stage.until->ground_at_least && lift_case.supports.empty() && !lift_case.ground_contact)
      diagnostics.error(stage.until->ground_at_least->mark,
                        fmt::format("stage \"{}\" waits for the ground to bear, and nothing is "
                                    "there that would",
                                    stage.name.value),
                        {"give supports, or ground_contact"});
  }
}

}  // namespace

void check_operation(const LiftCase& lift_case, Diagnostics& diagnostics) {
  check_conditions(lift_case, diagnostics);
  const Schedule schedule = schedule_operation(lift_case, diagnostics);
  check_duration(lift_case, schedule, diagnostics);
  check_keeping(lift_case, schedule, diagnostics);
  FaultCheck faults(lift_case, schedule, diagnostics);
  for (const given::Fault& fault : lift_case.faults) faults.check(fault);
}

}  // namespace blocklift::pipeline
