#include "dynamics/multibody/motion_profile.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  throw ModelError(stream.str());
}

bool positive(double value) { return value > 0 && std::isfinite(value); }

std::vector<double> sorted_unique(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

// ---- RestToRestMove ----------------------------------------------------------------------------

RestToRestMove::RestToRestMove(double start, double distance, const MotionLimits& limits)
    : start_(start), distance_(distance) {
  if (!std::isfinite(start)) refuse("a move's start time is not finite");
  if (!std::isfinite(distance)) refuse("a move's distance is not finite");
  if (!positive(limits.speed) || !positive(limits.acceleration) || !positive(limits.jerk)) {
    refuse("a move's limits are speed ", limits.speed, ", acceleration ", limits.acceleration,
           ", jerk ", limits.jerk, "; all three must be positive and finite");
  }
  const double length = std::abs(distance);
  if (length == 0) return;
  const double a = limits.acceleration;
  // Times to reach the full speed, the acceleration being reached on the way or not.
  if (limits.speed * limits.jerk < a * a) {
    jerk_time_ = std::sqrt(limits.speed / limits.jerk);
  } else {
    jerk_time_ = a / limits.jerk;
    acceleration_time_ = limits.speed / a - jerk_time_;
  }
  const double ramps = limits.speed * (2 * jerk_time_ + acceleration_time_);
  if (length >= ramps) {
    cruise_time_ = (length - ramps) / limits.speed;
  } else {
    // Too short for the full speed: a (t_j + t_a) (2 t_j + t_a) = length with t_j = a / jerk, or,
    // if that asks for a negative t_a, too short for the full acceleration as well: 2 jerk t_j^3 =
    // length.
    jerk_time_ = a / limits.jerk;
    acceleration_time_ =
        0.5 * (std::sqrt(jerk_time_ * jerk_time_ + 4 * length / a) - 3 * jerk_time_);
    if (acceleration_time_ < 0) {
      acceleration_time_ = 0;
      jerk_time_ = std::cbrt(0.5 * length / limits.jerk);
    }
  }
  jerk_ = distance / (jerk_time_ * (jerk_time_ + acceleration_time_) *
                      (2 * jerk_time_ + acceleration_time_ + cruise_time_));
}

RestToRestMove::RestToRestMove(double start, double distance, const MotionLimits& limits,
                               double duration)
    : RestToRestMove(start, distance, limits) {
  const double least = this->duration();
  if (!positive(duration)) refuse("a move's duration is ", duration, " s; it must be positive");
  if (duration < least * (1 - 1e-12)) {
    refuse("a move over ", distance, " is to last ", duration, " s but takes at least ", least,
           " s with speed ", limits.speed, ", acceleration ", limits.acceleration, ", jerk ",
           limits.jerk, "; give it more time, less distance or a faster drive");
  }
  if (least == 0) {
    cruise_time_ = duration;  // a rest of that length
    return;
  }
  const double stretch = duration / least;
  jerk_time_ *= stretch;
  acceleration_time_ *= stretch;
  cruise_time_ *= stretch;
  jerk_ /= stretch * stretch * stretch;
}

ProfileValue RestToRestMove::first_half(double time_since_start) const {
  double t = time_since_start;
  if (t <= jerk_time_) return {jerk_ * t * t * t / 6, jerk_ * t * t / 2, jerk_ * t};
  const double tj = jerk_time_;
  const double a = jerk_ * tj;
  ProfileValue at{a * tj * tj / 6, a * tj / 2, a};
  t -= tj;
  const double constant = std::min(t, acceleration_time_);
  at.position += constant * (at.velocity + constant * a / 2);
  at.velocity += constant * a;
  t -= constant;
  if (t <= 0) return at;
  const double easing = std::min(t, tj);
  at.position += easing * (at.velocity + easing * (a / 2 - jerk_ * easing / 6));
  at.velocity += easing * (a - jerk_ * easing / 2);
  at.acceleration = a - jerk_ * easing;
  t -= easing;
  if (t <= 0) return at;
  at.position += t * at.velocity;
  at.acceleration = 0;
  return at;
}

ProfileValue RestToRestMove::evaluate(double t) const {
  const double since_start = t - start_;
  if (since_start <= 0) return {0, 0, 0};
  const double until_end = duration() - since_start;
  if (until_end <= 0) return {distance_, 0, 0};
  if (since_start <= until_end) return first_half(since_start);
  // The second half mirrors the first.
  const ProfileValue mirror = first_half(until_end);
  return {distance_ - mirror.position, mirror.velocity, -mirror.acceleration};
}

std::vector<double> RestToRestMove::breakpoints() const {
  const double T = duration();
  const double tj = jerk_time_;
  const double ta = acceleration_time_;
  std::vector<double> times;
  for (const double since_start :
       {0.0, tj, tj + ta, 2 * tj + ta, T - 2 * tj - ta, T - tj - ta, T - tj, T}) {
    times.push_back(start_ + since_start);
  }
  return sorted_unique(times);
}

// ---- NaturalSpline -----------------------------------------------------------------------------

NaturalSpline::NaturalSpline(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), curvature_(x_.size(), 0.0) {
  const std::size_t n = x_.size();
  if (n != y_.size()) refuse("a spline has ", n, " abscissae and ", y_.size(), " values");
  if (n < 2) refuse("a spline has ", n, " points; it needs two at least");
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(x_[i]) || !std::isfinite(y_[i]))
      refuse("a spline's point ", i + 1, " is not finite");
    if (i > 0 && !(x_[i] > x_[i - 1])) {
      refuse("a spline's abscissae must increase, but ", x_[i], " follows ", x_[i - 1]);
    }
  }
  // Tridiagonal system for the curvatures, zero at both ends (Thomas' algorithm).
  std::vector<double> factor(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x_[i] - x_[i - 1];
    const double right = x_[i + 1] - x_[i];
    const double rhs = 6 * ((y_[i + 1] - y_[i]) / right - (y_[i] - y_[i - 1]) / left);
    const double pivot = 2 * (left + right) - left * factor[i - 1];
    factor[i] = right / pivot;
    curvature_[i] = (rhs - left * curvature_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i > 0; --i) curvature_[i] -= factor[i] * curvature_[i + 1];
}

ProfileValue NaturalSpline::evaluate(double x) const {
  const auto slope_within = [&](std::size_t i) {
    return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
  };
  if (x <= x_.front()) {
    const double slope = slope_within(0) - (x_[1] - x_[0]) * curvature_[1] / 6;
    return {y_.front() + slope * (x - x_.front()), slope, 0};
  }
  if (x >= x_.back()) {
    const std::size_t i = x_.size() - 2;
    const double slope = slope_within(i) + (x_[i + 1] - x_[i]) * curvature_[i] / 6;
    return {y_.back() + slope * (x - x_.back()), slope, 0};
  }
  const auto upper = std::upper_bound(x_.begin(), x_.end(), x);
  const auto i = static_cast<std::size_t>(upper - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i];
  const double b = (x - x_[i]) / h;
  const double a = 1 - b;
  const double ca = curvature_[i];
  const double cb = curvature_[i + 1];
  return {a * y_[i] + b * y_[i + 1] + ((a * a * a - a) * ca + (b * b * b - b) * cb) * h * h / 6,
          slope_within(i) + ((3 * b * b - 1) * cb - (3 * a * a - 1) * ca) * h / 6, a * ca + b * cb};
}

// ---- MotionProfile -----------------------------------------------------------------------------

struct MotionProfile::Cam {
  MotionProfile leader;
  NaturalSpline spline;
};

struct MotionProfile::Sum {
  std::vector<MotionProfile> parts;
};

struct MotionProfile::Stopped {
  MotionProfile profile;
  double start;
  double duration;
};

// A course with the travel and speed that it has at each of its instants.
struct MotionProfile::Steered {
  Course course;
  std::vector<double> travel, speed;

  ProfileValue evaluate(double t) const {
    const double since = t - course.start;
    if (since <= 0.0) return {0, 0, 0};
    const double h = course.interval;
    const auto& a = course.accelerations;
    const std::size_t last = a.size() - 1;
    const auto k = static_cast<std::size_t>(std::min(since / h, static_cast<double>(last)));
    const double s = since - static_cast<double>(k) * h;
    if (k == last) return {travel[k] + speed[k] * s, speed[k], 0.0};
    const double jerk = (a[k + 1] - a[k]) / h;
    return {travel[k] + s * (speed[k] + s * (a[k] / 2 + s * jerk / 6)),
            speed[k] + s * (a[k] + s * jerk / 2), a[k] + s * jerk};
  }
};

MotionProfile::MotionProfile(Content content, std::vector<double> breakpoints)
    : content_(std::move(content)), breakpoints_(sorted_unique(std::move(breakpoints))) {}

MotionProfile MotionProfile::constant(double value) { return sequence(value, {}); }

MotionProfile MotionProfile::sequence(double initial, std::vector<RestToRestMove> moves) {
  if (!std::isfinite(initial)) refuse("a profile's initial position is not finite");
  std::sort(moves.begin(), moves.end(),
            [](const RestToRestMove& a, const RestToRestMove& b) { return a.start() < b.start(); });
  std::vector<double> breakpoints;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    // Stages may follow each other without a pause: what rounding leaves between them is no
    // overlap.
    const double slack = 1e-9 * (1 + std::abs(moves[i].start()));
    if (i > 0 && moves[i].start() < moves[i - 1].end() - slack) {
      refuse("a move starts at ", moves[i].start(), " s while the one before it, started at ",
             moves[i - 1].start(), " s, lasts until ", moves[i - 1].end(),
             " s; let it start later or make the other faster");
    }
    const std::vector<double> times = moves[i].breakpoints();
    breakpoints.insert(breakpoints.end(), times.begin(), times.end());
  }
  return {Sequence{initial, std::move(moves)}, std::move(breakpoints)};
}

MotionProfile MotionProfile::cam(MotionProfile leader, NaturalSpline spline) {
  const ProfileRange range = leader.range();
  const double slack = 1e-9 * (spline.last_x() - spline.first_x());
  if (range.lowest < spline.first_x() - slack || range.highest > spline.last_x() + slack) {
    refuse("a cam is given from ", spline.first_x(), " to ", spline.last_x(),
           " but its leader goes from ", range.lowest, " to ", range.highest,
           "; give points over the whole travel");
  }
  std::vector<double> breakpoints = leader.breakpoints();
  return {std::make_shared<const Cam>(Cam{std::move(leader), std::move(spline)}),
          std::move(breakpoints)};
}

MotionProfile MotionProfile::along(NaturalSpline spline) {
  std::vector<double> breakpoints = spline.knots();
  return {std::make_shared<const NaturalSpline>(std::move(spline)), std::move(breakpoints)};
}

MotionProfile MotionProfile::along(Course course) {
  const std::vector<double>& a = course.accelerations;
  const double h = course.interval;
  const bool finite = std::all_of(a.begin(), a.end(), [](double x) { return std::isfinite(x); });
  if (!positive(h) || !std::isfinite(course.start) || a.empty() || !finite) {
    refuse("a course of ", a.size(), " accelerations every ", h, " s from ", course.start,
           " s on; finite ones, at least one, and a positive interval are due");
  }
  std::vector<double> travel{0.0}, speed{0.0}, breakpoints;
  const auto time = [&](std::size_t k) { return course.start + static_cast<double>(k) * h; };
  double jerk_before = 0.0;
  for (std::size_t k = 0; k + 1 < a.size(); ++k) {
    const double jerk = (a[k + 1] - a[k]) / h;
    if (jerk != jerk_before) breakpoints.push_back(time(k));
    jerk_before = jerk;
    travel.push_back(travel[k] + h * (speed[k] + h * (2 * a[k] + a[k + 1]) / 6));
    speed.push_back(speed[k] + h * (a[k] + a[k + 1]) / 2);
  }
  if (jerk_before != 0.0 || a.back() != 0.0) breakpoints.push_back(time(a.size() - 1));
  return {std::make_shared<const Steered>(
              Steered{std::move(course), std::move(travel), std::move(speed)}),
          std::move(breakpoints)};
}

MotionProfile MotionProfile::sum(std::vector<MotionProfile> parts) {
  std::vector<double> breakpoints;
  for (const MotionProfile& part : parts) {
    breakpoints.insert(breakpoints.end(), part.breakpoints().begin(), part.breakpoints().end());
  }
  return {std::make_shared<const Sum>(Sum{std::move(parts)}), std::move(breakpoints)};
}

MotionProfile MotionProfile::stopped(MotionProfile profile, double start, double duration) {
  if (!(duration > 0.0)) refuse("a motion is stopped within ", duration, " s; some time is due");
  std::vector<double> breakpoints{start, start + duration};
  for (const double time : profile.breakpoints()) {
    if (time <= start) breakpoints.push_back(time);
    // The clock shows this time where  time = start + s - s^2 / (2 duration).
    const double left = 1.0 - 2.0 * (time - start) / duration;
    if (time > start && left > 0.0)
      breakpoints.push_back(start + duration * (1.0 - std::sqrt(left)));
  }
  return {std::make_shared<const Stopped>(Stopped{std::move(profile), start, duration}),
          std::move(breakpoints)};
}

ProfileValue MotionProfile::evaluate(double t) const {
  if (const auto* sequence = std::get_if<Sequence>(&content_)) {
    ProfileValue value{sequence->initial, 0, 0};
    for (const RestToRestMove& move : sequence->moves) {
      if (t <= move.start()) break;
      if (t - move.start() >= move.duration()) {  // most moves are over most of the time
        value.position += move.distance();
        continue;
      }
      const ProfileValue part = move.evaluate(t);
      value.position += part.position;
      value.velocity += part.velocity;
      value.acceleration += part.acceleration;
    }
    return value;
  }
  if (const auto* cam = std::get_if<std::shared_ptr<const Cam>>(&content_)) {
    const ProfileValue x = (*cam)->leader.evaluate(t);
    const ProfileValue y = (*cam)->spline.evaluate(x.position);
    return {y.position, y.velocity * x.velocity,
            y.acceleration * x.velocity * x.velocity + y.velocity * x.acceleration};
  }
  if (const auto* spline = std::get_if<std::shared_ptr<const NaturalSpline>>(&content_)) {
    return (*spline)->evaluate(t);
  }
  if (const auto* steered = std::get_if<std::shared_ptr<const Steered>>(&content_)) {
    return (*steered)->evaluate(t);
  }
  if (const auto* stopped = std::get_if<std::shared_ptr<const Stopped>>(&content_)) {
    const auto& [profile, start, duration] = **stopped;
    if (t <= start) return profile.evaluate(t);
    const double s = std::min(t - start, duration);
    const ProfileValue x = profile.evaluate(start + s * (1.0 - 0.5 * s / duration));
    const double pace = 1.0 - s / duration;
    const double slowing = t < start + duration ? -1.0 / duration : 0.0;
    return {x.position, x.velocity * pace, x.acceleration * pace * pace + x.velocity * slowing};
  }
  ProfileValue value{0, 0, 0};
  for (const MotionProfile& part : std::get<std::shared_ptr<const Sum>>(content_)->parts) {
    const ProfileValue addend = part.evaluate(t);
    value.position += addend.position;
    value.velocity += addend.velocity;
    value.acceleration += addend.acceleration;
  }
  return value;
}

ProfileRange MotionProfile::range() const {
  const double initial = evaluate(breakpoints_.empty() ? 0 : breakpoints_.front()).position;
  ProfileRange range{initial, initial, 0, 0};
  const auto include = [&](double t) {
    const ProfileValue value = evaluate(t);
    range.lowest = std::min(range.lowest, value.position);
    range.highest = std::max(range.highest, value.position);
    range.peak_speed = std::max(range.peak_speed, std::abs(value.velocity));
    range.peak_acceleration = std::max(range.peak_acceleration, std::abs(value.acceleration));
  };
  for (std::size_t i = 0; i + 1 < breakpoints_.size(); ++i) {
    for (int k = 0; k < 64; ++k) {
      include(breakpoints_[i] + k / 64.0 * (breakpoints_[i + 1] - breakpoints_[i]));
    }
  }
  if (!breakpoints_.empty()) include(breakpoints_.back());
  return range;
}

}  // namespace blocklift::dynamics
