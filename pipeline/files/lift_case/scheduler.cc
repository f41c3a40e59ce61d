// The way from stages and moves to times.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/files/lift_case/drive_dimensions.h"
#include "pipeline/files/lift_case/operation_schedule.h"

namespace blocklift::pipeline {
namespace {

constexpr double touching = 1e-9;       // s: moves that share less do not overlap
constexpr double round_off = 1e-9;      // relative, on ranges and limits
constexpr double profile_slack = 1e-6;  // relative, on extremes of a follower found by sampling

/// Gathers a schedule stage by stage, following each drive's coordinate.
class Scheduler {
 public:
  Scheduler(OperationPlan plan, Diagnostics& diagnostics)
      : plan_(std::move(plan)), diagnostics_(diagnostics) {
    schedule_.movers = plan_.movers;
    for (const Mover& mover : schedule_.movers) coordinates_.push_back(mover.start);
  }

  Schedule run() {
    double time = 0;
    for (const given::Stage& stage : *plan_.stages) {
      time = add_stage(stage, time + (std::isfinite(stage.pause) ? stage.pause : 0));
    }
    schedule_.duration = time + (std::isfinite(plan_.settle) ? plan_.settle : 0);
    return std::move(schedule_);
  }

 private:
  /// Adds a stage that begins at `start`; returns its end.
  double add_stage(const given::Stage& stage, double start) {
    stage_ = &stage;
    stage_index_ = schedule_.stages.size();
    errors_before_stage_ = diagnostics_.error_count();
    schedule_.stages.push_back({stage.name.value, start, start});
    std::vector<const given::Move*> moves;
    for (const given::Move& move : stage.moves) moves.push_back(&move);
    std::stable_sort(moves.begin(), moves.end(), [](const given::Move* a, const given::Move* b) {
      return a->delay < b->delay;
    });
    for (const given::Move* move : moves) {
      if (!move->follows && !move->keeps) add_moves(*move, start);
    }
    for (const given::Move* move : moves) {
      if (move->follows && !move->keeps) add_followers(*move);
    }
    moves_end_ = schedule_.stages.back().end;
    for (const given::Move* move : moves) {
      if (move->keeps) add_keeping(*move, start);
    }
    if (stage.until) end_by_condition(*stage.until);
    take_courses();
    return schedule_.stages.back().end;
  }

  /// How far a drive of this stage has gone at any time since the stage's start.
  struct Travel {
    std::size_t mover;
    dynamics::MotionProfile profile;
  };

  std::vector<Travel> travels_of_stage() const {
    using dynamics::MotionProfile;
    std::vector<Travel> travels;
    for (const ScheduledMove& move : schedule_.moves)
      if (move.stage == stage_index_)
        travels.push_back({move.mover, MotionProfile::sequence(0, {move.move})});
    for (const ScheduledFollower& follower : schedule_.followers) {
      if (follower.stage != stage_index_) continue;
      std::vector<dynamics::RestToRestMove> leading;
      for (const ScheduledMove& move : schedule_.moves)
        if (move.stage == stage_index_ && move.mover == follower.leader)
          leading.push_back(move.move);
      std::sort(leading.begin(), leading.end(),
                [](const auto& a, const auto& b) { return a.start() < b.start(); });
      travels.push_back(
          {follower.mover, MotionProfile::cam(MotionProfile::sequence(0, std::move(leading)),
                                              follower.own_travel_over_leaders)});
    }
    return travels;
  }

  void end_by_condition(const StageUntil& until) {
    ScheduledStage& stage = schedule_.stages.back();
    stage.limit = until.within ? stage.start + *until.within : stage.end;
    if (conditions_ == plan_.found.met.size()) {
      stage.end = std::max(stage.end, *stage.limit);
      return;
    }
    const double planned_end = stage.end;
    const double met = plan_.found.met[conditions_++];
    const double time = met + until.reaction;
    const std::vector<Travel> travels = travels_of_stage();
    // One clock slows down for all, so that followers keep to their leaders.
    constexpr double shortest = 0.1;  // s
    double duration = shortest;
    for (const Travel& travel : travels)
      duration = std::max(duration, std::abs(travel.profile.evaluate(time).velocity) /
                                        schedule_.movers[travel.mover].limits.acceleration);
    stage.stop = {met, time, duration};
    stage.end = time + duration;
    for (const Travel& travel : travels) {
      const auto stopped = dynamics::MotionProfile::stopped(travel.profile, time, duration);
      coordinates_[travel.mover] +=
          stopped.evaluate(stage.end).position - travel.profile.evaluate(planned_end).position;
    }
    for (ScheduledSteering& steered : schedule_.steerings) {
      if (steered.stage != stage_index_) continue;
      steered.steering.end = std::clamp(time, steered.steering.start, steered.steering.end);
      stage.end = std::max(stage.end, steered.steering.stand());
    }
  }

  /// Courses that are known, of this stage's steered drives.
  void take_courses() {
    for (ScheduledSteering& steered : schedule_.steerings) {
      if (steered.stage != stage_index_) continue;
      if (courses_ == plan_.found.courses.size()) {
        unknown_.insert(steered.mover);
        continue;
      }
      steered.course = plan_.found.courses[courses_++];
      coordinates_[steered.mover] += dynamics::MotionProfile::along(*steered.course)
                                         .evaluate(steered.steering.stand())
                                         .position;
    }
  }

  /// Index of the drive of that name, or nothing: after a complaint, or because it is incomplete.
  std::optional<std::size_t> find_mover(const Located<std::string>& name) {
    if (name.value.empty()) return std::nullopt;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < schedule_.movers.size(); ++i) {
      if (schedule_.movers[i].name == name.value) return i;
      known.push_back(schedule_.movers[i].name);
    }
    if (plan_.is_incomplete(name.value)) return std::nullopt;
    if (known.empty() && diagnostics_.has_errors())
      return std::nullopt;  // cranes are complained of
    diagnostics_.error(name.mark,
                       fmt::format("stage \"{}\" moves \"{}\", which is no drive or winch of {}",
                                   stage_->name.value, name.value, plan_.owner),
                       {names_hint("its drives and winches are", known, name.value)});
    return std::nullopt;
  }

  void add_moves(const given::Move& move, double stage_start) {
    if (move.table) {
      diagnostics_.error(move.table->mark, "a table goes with \"follows\"",
                         {"name the drive that leads: follows: C1.lower"});
    }
    if (move.by.has_value() == move.to.has_value()) {
      diagnostics_.error(
          move.place,
          move.by ? "the move has both \"by\" and \"to\""
                  : "the move has neither \"by\" nor \"to\"",
          {"a move goes by a distance, to a place, follows another drive, or keeps something"});
      return;
    }
    for (const Located<std::string>& name : move.drives) {
      if (const auto mover = find_mover(name)) add_move(move, name, *mover, stage_start);
    }
  }

  void add_move(const given::Move& move, const Located<std::string>& name, std::size_t index,
                double stage_start) {
    const Mover& mover = schedule_.movers[index];
    const Located<Quantity>& travel = move.by ? *move.by : *move.to;
    if (!std::isfinite(travel.value.value) || !std::isfinite(move.delay)) return;
    if (travel.value.dimension != mover.travel) {
      diagnostics_.error(travel.mark,
                         fmt::format("{} moves by {}, but the move goes {} {}", name.value,
                                     text_of(mover.travel).noun, move.by ? "by" : "to",
                                     text_of(travel.value.dimension).noun));
      return;
    }
    dynamics::MotionLimits limits = mover.limits;
    if (!take_limits(move, mover, limits)) return;
    const double distance = move.by ? travel.value.value : travel.value.value - coordinates_[index];
    const double start = stage_start + move.delay;
    std::optional<dynamics::RestToRestMove> planned;
    try {
      planned = move.duration
                    ? dynamics::RestToRestMove(start, distance, limits, move.duration->value)
                    : dynamics::RestToRestMove(start, distance, limits);
    } catch (const dynamics::ModelError& error) {
      diagnostics_.error(move.duration ? move.duration->mark : move.place,
                         fmt::format("{}: {}", name.value, error.what()));
      return;
    }
    if (!check_overlap(index, *planned, stage_start, name)) return;
    schedule_.moves.push_back({index, stage_index_, *planned, name.mark});
    schedule_.stages.back().end = std::max(schedule_.stages.back().end, planned->end());
    const double before = coordinates_[index];
    coordinates_[index] += distance;
    if (move.to && unknown_.erase(index) > 0 && !schedule_.provisional_from)
      schedule_.provisional_from = stage_index_;
    check_range(index, before, coordinates_[index], name.mark);
  }

  /// The limits of the move where it gives its own; complains where they exceed the drive's.
  bool take_limits(const given::Move& move, const Mover& mover, dynamics::MotionLimits& limits) {
    const bool turns = mover.travel == Dimension::angle;
    bool sound = true;
    const auto take = [&](const std::optional<Located<Quantity>>& own, Dimension due,
                          const char* key, double& limit) {
      if (!own || !std::isfinite(own->value.value)) return;
      if (own->value.dimension != due) {
        diagnostics_.error(
            own->mark, fmt::format("{} is {}, but {} {}", key, text_of(own->value.dimension).noun,
                                   mover.name, turns ? "turns" : "slides"));
        sound = false;
      } else if (own->value.value > limit * (1 + round_off)) {
        diagnostics_.error(own->mark,
                           fmt::format("{} {} is more than {} can do", key,
                                       format_quantity(own->value.value, due), mover.name),
                           {fmt::format("its largest {} is {}", key, format_quantity(limit, due))});
        sound = false;
      } else {
        limit = own->value.value;
      }
    };
    take(move.speed, speed_of(mover.travel), "speed", limits.speed);
    take(move.acceleration, acceleration_of(mover.travel), "acceleration", limits.acceleration);
    take(move.jerk, turns ? Dimension::angular_jerk : Dimension::jerk, "jerk", limits.jerk);
    return sound;
  }

  bool check_overlap(std::size_t index, const dynamics::RestToRestMove& planned, double stage_start,
                     const Located<std::string>& name) {
    for (const ScheduledMove& other : schedule_.moves) {
      if (other.mover != index || other.stage != stage_index_) continue;
      if (planned.start() >= other.move.end() - touching ||
          planned.end() <= other.move.start() + touching) {
        continue;
      }
      diagnostics_.error(
          name.mark,
          fmt::format("the operation overlaps itself: {} would begin this move at {:.6g} s, but "
                      "its move in line {} lasts until {:.6g} s",
                      name.value, planned.start(), other.mark.line, other.move.end()),
          {fmt::format("give the move a delay of at least {:.3f} s, or a stage of its own",
                       std::ceil((other.move.end() - stage_start) * 1000) / 1000)});
      return false;
    }
    return true;
  }

  /// Complains, once for each drive, when it leaves its range.
  void check_range(std::size_t index, double before, double coordinate, const Mark& mark) {
    const Mover& mover = schedule_.movers[index];
    const double slack = round_off * std::max(std::abs(mover.lowest), std::abs(mover.highest));
    if (mover.start < mover.lowest || mover.start > mover.highest) return;  // has been said
    if (unknown_.contains(index)) return;  // it will be seen once the course is known
    const bool outside = coordinate < mover.lowest - slack || coordinate > mover.highest + slack;
    if (!outside || !left_range_.insert(index).second) return;
    const auto in_words = [&](double value) { return format_quantity(value, mover.travel); };
    const std::string stage = fmt::format("in stage \"{}\"", stage_->name.value);
    std::string message;
    if (mover.is_winch && coordinate <= 0) {
      message = fmt::format(
          "winch {} would pull its rope through the sheave {}: its length would "
          "go from {} to {}",
          mover.name, stage, in_words(before), in_words(coordinate));
    } else {
      message = fmt::format("{} would go from {} to {} {}, outside its range", mover.name,
                            in_words(before), in_words(coordinate), stage);
    }
    diagnostics_.error(
        mark, std::move(message),
        {fmt::format("its range is {} to {}, and it starts the operation at {}",
                     in_words(mover.lowest), in_words(mover.highest), in_words(mover.start))});
  }

  void add_followers(const given::Move& move) {
    const auto refuse = [&](bool given, const char* key) {
      if (!given) return;
      diagnostics_.error(move.place,
                         fmt::format("a move that follows another drive takes no {}", key),
                         {"time and way come from the leader and the table"});
    };
    refuse(move.by || move.to, "\"by\" or \"to\"");
    refuse(move.speed || move.acceleration || move.jerk || move.duration,
           "speed, acceleration, jerk or duration");
    refuse(move.delay > 0, "delay");
    if (!move.table) {
      diagnostics_.error(move.place, "the move follows another drive and has no table",
                         {"add its own travel over the leader's: table: [[0 m, 0 m], [4 m, 1 m]]"});
      return;
    }
    const auto leader = find_mover(*move.follows);
    if (!leader) return;
    for (const Located<std::string>& name : move.drives) {
      if (const auto mover = find_mover(name)) add_follower(move, name, *mover, *leader);
    }
  }

  void add_follower(const given::Move& move, const Located<std::string>& name, std::size_t index,
                    std::size_t leader) {
    const auto fail = [&](const Mark& mark, std::string message, std::vector<std::string> hints) {
      diagnostics_.error(mark, std::move(message), std::move(hints));
    };
    const std::string& leader_name = schedule_.movers[leader].name;
    for (const ScheduledFollower& other : schedule_.followers) {
      if (other.stage == stage_index_ && (other.mover == leader || other.mover == index)) {
        fail(name.mark,
             other.mover == leader
                 ? fmt::format("{} follows {}, which itself follows another drive", name.value,
                               leader_name)
                 : fmt::format("the operation overlaps itself: {} follows two drives at once",
                               name.value),
             {});
        return;
      }
    }
    std::vector<dynamics::RestToRestMove> leading;
    for (const ScheduledMove& other : schedule_.moves) {
      if (other.stage != stage_index_) continue;
      if (other.mover == leader) leading.push_back(other.move);
      if (other.mover == index) {
        fail(name.mark,
             fmt::format("the operation overlaps itself: {} follows {} and has a move of its own "
                         "in line {}",
                         name.value, leader_name, other.mark.line),
             {});
        return;
      }
    }
    if (leading.empty()) {
      // The leader's move may be what was complained about.
      if (diagnostics_.error_count() > errors_before_stage_) return;
      fail(move.follows->mark,
           fmt::format("{} follows {}, which does not move in stage \"{}\"", name.value,
                       leader_name, stage_->name.value),
           {});
      return;
    }
    const auto spline = make_spline(*move.table, index, leader, leading);
    if (!spline) return;
    check_follower(name, index, leader_name, *spline, leading);
    schedule_.followers.push_back({index, leader, stage_index_, *spline, name.mark});
  }

  void add_keeping(const given::Move& move, double stage_start) {
    const auto refuse = [&](bool given, const char* keys) {
      if (given)
        diagnostics_.error(move.place, fmt::format("a move that keeps something takes no {}", keys),
                           {"its way is what the operator finds"});
    };
    refuse(move.by || move.to, "\"by\" or \"to\"");
    refuse(move.follows || move.table, "\"follows\" or table");
    const double start = stage_start + (std::isfinite(move.delay) ? move.delay : 0);
    const given::Stage& stage = *stage_;
    double end = moves_end_;
    if (stage.until && stage.until->within) end = std::max(end, stage_start + *stage.until->within);
    if (move.duration) end = start + move.duration->value;
    if (!(end > start)) {
      // The moves that it goes with may be what was complained about.
      if (diagnostics_.error_count() == errors_before_stage_)
        diagnostics_.error(
            move.place,
            fmt::format("nothing says how long stage \"{}\" keeps this", stage.name.value),
            {"give the move a duration, or the stage other moves"});
      return;
    }
    for (const Located<std::string>& name : move.drives) {
      if (const auto mover = find_mover(name)) add_steering(move, name, *mover, start, end);
    }
  }

  void add_steering(const given::Move& move, const Located<std::string>& name, std::size_t index,
                    double start, double end) {
    const auto overlap = [&](std::size_t stage, std::size_t mover, const Mark& mark) {
      if (stage != stage_index_ || mover != index) return false;
      diagnostics_.error(name.mark,
                         fmt::format("the operation overlaps itself: {} keeps something and has a "
                                     "move of its own in line {}",
                                     name.value, mark.line));
      return true;
    };
    for (const auto& other : schedule_.moves)
      if (overlap(other.stage, other.mover, other.mark)) return;
    for (const auto& other : schedule_.followers)
      if (overlap(other.stage, other.mover, other.mark)) return;
    for (const auto& other : schedule_.steerings)
      if (overlap(other.stage, other.mover, other.mark)) return;
    const Mover& mover = schedule_.movers[index];
    const given::Keep& keep = *move.keeps;
    dynamics::MotionLimits limits = mover.limits;
    if (!take_limits(move, mover, limits)) return;
    dynamics::Steering steering;
    steering.drive = mover.name;
    steering.start = start;
    steering.end = end;
    steering.reaction = keep.reaction;
    steering.correction_time = keep.correction_time();
    steering.tolerance = keep.tolerance ? keep.tolerance->value.value : 0.0;
    if (keep.every) steering.longest_interval = *keep.every;
    steering.limits = limits;
    steering.lowest = mover.lowest;
    steering.highest = mover.highest;
    if (!std::isfinite(start + end + keep.reaction + keep.correction_time() +
                       steering.longest_interval))
      return;
    schedule_.stages.back().end = std::max(schedule_.stages.back().end, steering.stand());
    schedule_.steerings.push_back({index, stage_index_, steering, keep, {}, name.mark});
  }

  /// The table as a smooth curve; complains if it cannot be one or does not cover the leader's way.
  std::optional<dynamics::NaturalSpline> make_spline(
      const Located<std::vector<std::array<Quantity, 2>>>& table, std::size_t index,
      std::size_t leader, const std::vector<dynamics::RestToRestMove>& leading) {
    const auto fail = [&](std::string message, std::vector<std::string> hints = {}) {
      diagnostics_.error(table.mark, std::move(message), std::move(hints));
      return std::nullopt;
    };
    if (table.value.size() < 2) return std::nullopt;  // the reader has complained
    std::vector<std::pair<double, double>> points;
    for (const auto& [leaders, own] : table.value) {
      if (!std::isfinite(leaders.value) || !std::isfinite(own.value)) return std::nullopt;
      if (leaders.dimension != schedule_.movers[leader].travel ||
          own.dimension != schedule_.movers[index].travel) {
        return fail(fmt::format(
            "the table gives {} over {}, but {} moves by {} and {} by {}",
            text_of(own.dimension).noun, text_of(leaders.dimension).noun,
            schedule_.movers[index].name, text_of(schedule_.movers[index].travel).noun,
            schedule_.movers[leader].name, text_of(schedule_.movers[leader].travel).noun));
      }
      points.emplace_back(leaders.value, own.value);
    }
    if (points.front() != std::pair(0.0, 0.0)) {
      return fail("the table must begin with zero travel of both", {"for example [0 m, 0 m]"});
    }
    const auto ascending = [](const auto& a, const auto& b) { return a.first >= b.first; };
    if (points[1].first < 0) std::reverse(points.begin(), points.end());
    if (std::adjacent_find(points.begin(), points.end(), ascending) != points.end()) {
      return fail("the leader's travel must grow from point to point of the table");
    }
    double travel = 0;
    for (const dynamics::RestToRestMove& move : leading) {
      travel += move.distance();
      const double slack = round_off * std::abs(points.back().first - points.front().first);
      if (travel < points.front().first - slack || travel > points.back().first + slack) {
        const Dimension kind = schedule_.movers[leader].travel;
        const double last = table.value.back()[0].value;
        return fail(fmt::format("the table ends at {}, but {} travels {} in stage \"{}\"",
                                format_quantity(last, kind), schedule_.movers[leader].name,
                                format_quantity(travel, kind), stage_->name.value));
      }
    }
    std::vector<double> x, y;
    for (const auto& [leaders, own] : points) {
      x.push_back(leaders);
      y.push_back(own);
    }
    return dynamics::NaturalSpline(std::move(x), std::move(y));
  }

  /// Complains if following takes the drive beyond its limits or its range.
  void check_follower(const Located<std::string>& name, std::size_t index,
                      const std::string& leader_name, const dynamics::NaturalSpline& spline,
                      std::vector<dynamics::RestToRestMove> leading) {
    const Mover& mover = schedule_.movers[index];
    std::sort(leading.begin(), leading.end(),
              [](const auto& a, const auto& b) { return a.start() < b.start(); });
    double travel = 0;
    for (const dynamics::RestToRestMove& move : leading) travel += move.distance();
    const double own_travel = spline.evaluate(travel).position;
    const dynamics::ProfileRange range =
        dynamics::MotionProfile::cam(dynamics::MotionProfile::sequence(0, std::move(leading)),
                                     spline)
            .range();
    const auto check_limit = [&](double needed, double limit, Dimension kind, const char* noun) {
      if (needed <= limit * (1 + profile_slack)) return;
      diagnostics_.error(
          name.mark,
          fmt::format("{} would need {} {} to follow {}", name.value, text_of(kind).noun,
                      "of " + format_quantity(needed, kind), leader_name),
          {fmt::format("its largest {} is {}; let the leader go slower or smooth "
                       "the table",
                       noun, format_quantity(limit, kind))});
    };
    check_limit(range.peak_speed, mover.limits.speed, speed_of(mover.travel), "speed");
    check_limit(range.peak_acceleration, mover.limits.acceleration, acceleration_of(mover.travel),
                "acceleration");
    const double before = coordinates_[index];
    check_range(index, before, before + range.lowest, name.mark);
    check_range(index, before, before + range.highest, name.mark);
    coordinates_[index] += own_travel;
  }

  OperationPlan plan_;
  Diagnostics& diagnostics_;
  Schedule schedule_;
  std::vector<double> coordinates_;  // of each mover, after what is scheduled so far
  std::set<std::size_t> left_range_;
  const given::Stage* stage_ = nullptr;
  std::size_t stage_index_ = 0;
  std::size_t errors_before_stage_ = 0;
  double moves_end_ = 0;           // of the stage's moves and followers, s
  std::size_t conditions_ = 0;     // that came about so far
  std::size_t courses_ = 0;        // that are known so far
  std::set<std::size_t> unknown_;  // movers that were steered on a course not known yet
};

}  // namespace

Schedule schedule_operation(OperationPlan plan, Diagnostics& diagnostics) {
  return Scheduler(std::move(plan), diagnostics).run();
}

}  // namespace blocklift::pipeline
