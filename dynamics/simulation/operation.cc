#include "dynamics/simulation/operation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Moves may touch; they overlap when they share more than this (s).
constexpr double touching = 1e-9;
// Breakpoints nearer to one another than this are one for the integrator (s).
constexpr double smallest_interval = 1e-6;

std::string seconds(double t) { return std::to_string(t) + " s"; }

}  // namespace

void OperationBuilder::add_stage(std::string name, double start, double end) {
  const double earliest = operation_.stages_.empty() ? 0.0 : operation_.stages_.back().end;
  if (!(start >= earliest - touching)) {
    throw ModelError("stage \"" + name + "\" begins at " + seconds(start) +
                     ", before the one before it ends at " + seconds(earliest));
  }
  if (!(end >= start) || !std::isfinite(end)) {
    throw ModelError("stage \"" + name + "\" ends at " + seconds(end) + ", before it begins at " +
                     seconds(start));
  }
  operation_.stages_.push_back({std::move(name), start, end});
}

void OperationBuilder::add_track(const std::string& name, bool is_winch, std::size_t index,
                                 double start) {
  if (!std::isfinite(start)) {
    throw ModelError("drive \"" + name + "\" needs the position at which it starts");
  }
  for (const Track& track : tracks_) {
    if (track.name == name) throw ModelError("there are two drives named \"" + name + "\"");
  }
  tracks_.push_back({name, is_winch, index, start, {}, {}, {}});
}

void OperationBuilder::add_joint_drive(const Mechanism& mechanism, std::string name, BodyIndex body,
                                       double start, int degree_of_freedom) {
  const Body& b = mechanism.body(body);
  const auto k = static_cast<std::size_t>(degree_of_freedom);
  if (degree_of_freedom < 0 || degree_of_freedom >= b.nv() || k >= b.driven.size() ||
      !b.driven[k]) {
    throw ModelError("drive \"" + name + "\": the " + std::string(joint_kind_name(b.joint.kind)) +
                     " joint of \"" + b.name + "\" has no driven degree of freedom " +
                     std::to_string(degree_of_freedom) + "; declare it as driven in the mechanism");
  }
  if (!velocities_are_rates(b.joint.kind)) {
    throw ModelError(
        "drive \"" + name + "\": a " + std::string(joint_kind_name(b.joint.kind)) +
        " joint has no coordinate of its own for each velocity; drive it along a direction");
  }
  const int velocity_index = b.v_offset + degree_of_freedom;
  for (const JointDrive& other : operation_.joint_drives_) {
    if (other.velocity_index == velocity_index) {
      throw ModelError("drives \"" + other.name + "\" and \"" + name + "\" move the same joint");
    }
  }
  add_track(name, false, operation_.joint_drives_.size(), start);
  operation_.joint_drives_.push_back({.name = std::move(name),
                                      .body = body,
                                      .velocity_index = velocity_index,
                                      .coordinate_index = b.q_offset + degree_of_freedom});
}

void OperationBuilder::add_direction_drive(const Mechanism& mechanism, std::string name,
                                           BodyIndex body, const Eigen::VectorXd& q0,
                                           const Eigen::VectorXd& direction) {
  const Body& b = mechanism.body(body);
  if (velocities_are_rates(b.joint.kind) || b.driven.empty() || !b.driven.front()) {
    throw ModelError("drive \"" + name + "\": the joint of \"" + b.name + "\" is " +
                     std::string(joint_kind_name(b.joint.kind)) +
                     "; a spherical or free joint that is declared as driven is due");
  }
  if (q0.size() != b.nq() || direction.size() != b.nv() || !q0.allFinite() ||
      !direction.allFinite()) {
    throw ModelError("drive \"" + name + "\": the " + std::string(joint_kind_name(b.joint.kind)) +
                     " joint of \"" + b.name + "\" takes " + std::to_string(b.nq()) +
                     " coordinates and a direction of " + std::to_string(b.nv()) + " numbers");
  }
  add_track(name, false, operation_.joint_drives_.size(), 0.0);
  operation_.joint_drives_.push_back({.name = std::move(name),
                                      .body = body,
                                      .velocity_index = b.v_offset,
                                      .coordinate_index = b.q_offset,
                                      .direction = direction,
                                      .start = q0});
}

void OperationBuilder::add_winch(std::string name, int rope, double start) {
  add_track(name, true, operation_.winches_.size(), start);
  operation_.winches_.push_back({std::move(name), rope, MotionProfile::constant(start)});
}

OperationBuilder::Track& OperationBuilder::find_track(std::string_view drive) {
  std::string names;
  for (Track& track : tracks_) {
    if (track.name == drive) return track;
    names += (names.empty() ? "" : ", ") + track.name;
  }
  throw ModelError("there is no drive \"" + std::string(drive) + "\"; the drives are " +
                   (names.empty() ? "none" : names));
}

void OperationBuilder::check_free(const Track& track, Interval wanted) const {
  const auto check = [&](double start, double end) {
    if (wanted.start < end - touching && wanted.end > start + touching) {
      throw ModelError("drive \"" + track.name + "\" is moved from " + seconds(wanted.start) +
                       " to " + seconds(wanted.end) + " while it still moves from " +
                       seconds(start) + " to " + seconds(end) +
                       "; let one move end before the next begins");
    }
  };
  if (track.motion) {
    throw ModelError("drive \"" + track.name +
                     "\" goes along a profile and cannot be moved besides");
  }
  if (!(wanted.start >= 0.0)) {
    throw ModelError("drive \"" + track.name + "\" is moved at " + seconds(wanted.start) +
                     ", before the operation begins at 0 s");
  }
  for (const RestToRestMove& move : track.moves) check(move.start(), move.end());
  for (const Follower& follower : track.followers) {
    check(follower.interval.start, follower.interval.end);
  }
  for (const Follower& part : track.stopped) check(part.interval.start, part.interval.end);
}

void OperationBuilder::add_move(std::string_view drive, const RestToRestMove& move) {
  Track& track = find_track(drive);
  check_free(track, {move.start(), move.end()});
  const auto later = std::find_if(track.moves.begin(), track.moves.end(),
                                  [&](const auto& other) { return other.start() > move.start(); });
  track.moves.insert(later, move);
}

void OperationBuilder::set_motion(std::string_view drive, MotionProfile motion) {
  Track& track = find_track(drive);
  if (track.is_winch || track.motion || !track.moves.empty() || !track.followers.empty()) {
    throw ModelError("drive \"" + track.name +
                     "\" cannot go along a profile: it is a winch, or is moved otherwise");
  }
  track.motion = std::move(motion);
}

void OperationBuilder::add_breakpoints(const std::vector<double>& times) {
  more_breakpoints_.insert(more_breakpoints_.end(), times.begin(), times.end());
}

void OperationBuilder::add_follower(std::string_view drive, std::string_view leader, double start,
                                    double end, const NaturalSpline& own_travel_over_leaders) {
  Track& track = find_track(drive);
  const Track& leading = find_track(leader);
  if (!leading.followers.empty()) {
    throw ModelError("drive \"" + track.name + "\" follows \"" + leading.name +
                     "\", which follows another drive itself; follow that one");
  }
  std::vector<RestToRestMove> moves;
  for (const RestToRestMove& move : leading.moves) {
    if (move.start() >= start - touching && move.end() <= end + touching) moves.push_back(move);
  }
  if (moves.empty()) {
    throw ModelError("drive \"" + track.name + "\" follows \"" + leading.name +
                     "\", which does not move between " + seconds(start) + " and " + seconds(end));
  }
  const double first = moves.front().start();
  const double last = moves.back().end();
  check_free(track, {first, last});
  try {
    const MotionProfile travel =
        MotionProfile::cam(MotionProfile::sequence(0.0, std::move(moves)), own_travel_over_leaders);
    track.followers.push_back({travel, {first, last}});
  } catch (const ModelError& error) {
    throw ModelError("drive \"" + track.name + "\" follows \"" + leading.name +
                     "\": " + error.what());
  }
}

namespace {

void check_steering(const Steering& s, const Operation& operation) {
  const auto refuse = [&](const std::string& what) {
    throw ModelError("drive \"" + s.drive + "\" cannot be steered: " + what);
  };
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const auto* own = std::get_if<OwnLaw>(&s.wish);
  if (!(s.start >= 0.0) || !(s.end >= s.start) || !std::isfinite(s.end))
    refuse("it would be from " + seconds(s.start) + " to " + seconds(s.end));
  if ((!own && !positive(s.correction_time)) || !positive(s.limits.speed) ||
      !positive(s.limits.acceleration) || !positive(s.limits.jerk) || !positive(s.longest_interval))
    refuse("its correction time, its limits and its interval must be positive");
  if (!(s.reaction >= 0.0) || !(s.tolerance >= 0.0) || !std::isfinite(s.reaction + s.tolerance))
    refuse("its reaction and its tolerance must not be negative");
  if (!(s.lowest <= s.highest)) refuse("it has no range");
  const auto is_plumb = [](const Sight& sight) { return std::holds_alternative<SeenPlumb>(sight); };
  if (own && !own->begin) refuse("its law is missing");
  if (own && s.is_winch && std::any_of(own->sights.begin(), own->sights.end(), is_plumb))
    refuse("a winch sees no plumb");
  if (!own && s.is_winch == std::holds_alternative<KeptPlumb>(s.wish))
    refuse("winches keep heights, tensions and shares, drives of joints a plumb");
  if (!s.is_winch) {
    if (operation.joint_drives()[s.index].direction.size() > 0)
      refuse("its joint is driven as a whole along a direction");
    return;
  }
  const int rope = operation.winches()[s.index].rope;
  const auto* tension = std::get_if<KeptTension>(&s.wish);
  const auto* share = std::get_if<KeptShare>(&s.wish);
  if ((tension && tension->rope != rope) || (share && share->rope != rope))
    refuse("a winch keeps the tension of its own rope");
  if ((tension && tension->stiffness && !positive(*tension->stiffness)) ||
      (share && share->stiffness && !positive(*share->stiffness)))
    refuse("a stiffness must be positive");
  if (share && share->others.empty()) refuse("a share is one of several ropes");
}

}  // namespace

void OperationBuilder::add_steering(std::string_view drive, Steering steering) {
  const Track& track = find_track(drive);
  steering.drive = track.name;
  steering.is_winch = track.is_winch;
  steering.index = track.index;
  check_steering(steering, operation_);
  check_free(track, {steering.start, steering.stand()});
  for (const Steering& other : operation_.steerings_) {
    if (other.drive == track.name && other.start < steering.stand() - touching &&
        steering.start < other.stand() - touching)
      throw ModelError("drive \"" + track.name + "\" is steered twice at once");
  }
  operation_.steerings_.push_back(std::move(steering));
}

void OperationBuilder::add_course(std::string_view drive, Course course, double stand) {
  Track& track = find_track(drive);
  const double start = course.start;
  check_free(track, {start, stand});
  track.stopped.push_back({MotionProfile::along(std::move(course)), {start, stand}});
}

double OperationBuilder::end() const {
  double end = operation_.stages_.empty() ? 0.0 : operation_.stages_.back().end;
  for (const Track& track : tracks_) {
    for (const RestToRestMove& move : track.moves) end = std::max(end, move.end());
  }
  for (const Steering& steering : operation_.steerings_) end = std::max(end, steering.stand());
  return end;
}

void OperationBuilder::add_stop(std::string_view drive, double time, double duration) {
  Track& track = find_track(drive);
  if (track.stop) throw ModelError("drive \"" + track.name + "\" is stopped twice");
  if (!(time >= 0.0) || !(duration > 0.0) || !std::isfinite(time + duration)) {
    throw ModelError("drive \"" + track.name + "\" cannot be stopped at " + seconds(time) +
                     " within " + seconds(duration));
  }
  track.stop = Interval{time, time + duration};
}

void OperationBuilder::add_runaway(std::string_view winch, double time, double duration,
                                   double speed, double ramp) {
  Track& track = find_track(winch);
  if (!track.is_winch)
    throw ModelError("drive \"" + track.name + "\" is no winch and cannot run away");
  if (!(duration > 0.0) || !(speed > 0.0) || !std::isfinite(duration * speed))
    throw ModelError("winch \"" + track.name + "\" cannot run away for " + seconds(duration) +
                     " at " + std::to_string(speed) + " m/s");
  add_stop(winch, time, ramp);
  // Its acceleration builds up in a hundredth of the ramp.
  const double acceleration = speed / ramp;
  track.runaway =
      RestToRestMove(time, speed * duration, {speed, acceleration, 100.0 * acceleration / ramp});
}

void OperationBuilder::stop_moves(double from, double time, double duration) {
  const double stand = time + duration;
  for (Track& track : tracks_) {
    const auto stop = [&](const MotionProfile& travel, Interval interval) {
      if (interval.start >= stand) return;
      // What a cam has at its start is no travel.
      const double offset = travel.evaluate(interval.start).position;
      MotionProfile stopped = MotionProfile::stopped(travel, time, duration);
      if (offset != 0.0)
        stopped = MotionProfile::sum({std::move(stopped), MotionProfile::constant(-offset)});
      track.stopped.push_back(
          {std::move(stopped), {interval.start, std::min(std::max(interval.end, time), stand)}});
    };
    const auto concerns = [&](double start) { return start >= from - touching; };
    for (const RestToRestMove& move : track.moves)
      if (concerns(move.start()))
        stop(MotionProfile::sequence(0.0, {move}), {move.start(), move.end()});
    for (const Follower& follower : track.followers)
      if (concerns(follower.interval.start)) stop(follower.travel, follower.interval);
    std::erase_if(track.moves, [&](const auto& move) { return concerns(move.start()); });
    std::erase_if(track.followers,
                  [&](const auto& follower) { return concerns(follower.interval.start); });
  }
}

void OperationBuilder::add_parting(int rope, double time) {
  if (!(time >= 0.0) || !std::isfinite(time))
    throw ModelError("a rope cannot part at " + seconds(time));
  for (const Parting& other : operation_.partings_) {
    if (other.rope == rope)
      throw ModelError("rope " + std::to_string(rope) + " parts at " + seconds(other.time) +
                       " and cannot part once more");
  }
  operation_.partings_.push_back({rope, time});
}

MotionProfile OperationBuilder::make_profile(const Track& track) const {
  MotionProfile profile = make_undisturbed_profile(track);
  if (!track.stop) return profile;
  MotionProfile stopped = MotionProfile::stopped(std::move(profile), track.stop->start,
                                                 track.stop->end - track.stop->start);
  if (!track.runaway) return stopped;
  return MotionProfile::sum({std::move(stopped), MotionProfile::sequence(0.0, {*track.runaway})});
}

MotionProfile OperationBuilder::make_undisturbed_profile(const Track& track) {
  if (track.motion) return *track.motion;
  MotionProfile own = MotionProfile::sequence(track.start_value, track.moves);
  if (track.followers.empty() && track.stopped.empty()) return own;
  std::vector<MotionProfile> parts{std::move(own)};
  for (const Follower& follower : track.followers) {
    // The cam's own value at the leader's start is not travel.
    parts.push_back(follower.travel);
    const double offset = follower.travel.evaluate(follower.interval.start).position;
    if (offset != 0.0) parts.push_back(MotionProfile::constant(-offset));
  }
  for (const Follower& part : track.stopped) parts.push_back(part.travel);
  return MotionProfile::sum(std::move(parts));
}

Operation OperationBuilder::build(double duration) const {
  if (!(duration > 0.0) || !std::isfinite(duration) || duration < end() - smallest_interval) {
    throw ModelError("the operation lasts " + seconds(duration) + ", but its last move ends at " +
                     seconds(end()) + "; it must last longer than 0 s and until then");
  }
  Operation operation = operation_;
  operation.duration_ = duration;
  for (const Track& track : tracks_) {
    if (!track.is_winch) {
      operation.joint_drives_[track.index].position = make_profile(track);
      continue;
    }
    MotionProfile& length = operation.winches_[track.index].length;
    length = make_profile(track);
    const double shortest = length.range().lowest;
    if (!(shortest > 0.0)) {
      throw ModelError("winch \"" + track.name + "\" would pull its rope in to " +
                       std::to_string(shortest) + " m; some length must stay out");
    }
  }
  for (Steering& steering : operation.steerings_) {
    const auto track = std::find_if(tracks_.begin(), tracks_.end(),
                                    [&](const Track& one) { return one.name == steering.drive; });
    steering.base = make_undisturbed_profile(*track);
    if (!track->stop) continue;
    steering.stop_time = track->stop->start;
    steering.stop_duration = track->stop->end - track->stop->start;
  }
  operation.breakpoints_ = collect_breakpoints(operation);
  return operation;
}

std::vector<double> OperationBuilder::collect_breakpoints(const Operation& operation) const {
  std::vector<double> times{0.0, operation.duration_};
  const auto add = [&](const std::vector<double>& more) {
    times.insert(times.end(), more.begin(), more.end());
  };
  for (const Stage& stage : operation.stages_) add({stage.start, stage.end});
  for (const JointDrive& drive : operation.joint_drives_) add(drive.position.breakpoints());
  for (const Winch& winch : operation.winches_) add(winch.length.breakpoints());
  for (const Parting& parting : operation.partings_) add({parting.time});
  for (const Steering& steering : operation.steerings()) {
    for (int look = 0; look <= steering.look_count(); ++look)
      times.push_back(steering.start + look * steering.interval());
    if (steering.stop_time)
      add({*steering.stop_time, *steering.stop_time + steering.stop_duration});
  }
  add(more_breakpoints_);
  std::sort(times.begin(), times.end());
  std::vector<double> breakpoints;
  for (const double t : times) {
    if (t < 0.0 || t > operation.duration_) continue;
    if (breakpoints.empty() || t > breakpoints.back() + smallest_interval) breakpoints.push_back(t);
  }
  if (breakpoints.size() == 1) {
    breakpoints.push_back(operation.duration_);
  } else {
    breakpoints.back() = operation.duration_;
  }
  return breakpoints;
}

}  // namespace blocklift::dynamics
