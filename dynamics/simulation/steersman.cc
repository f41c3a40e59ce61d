#include "dynamics/simulation/steersman.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Looks nearer to a breakpoint than this coincide with it (s).
constexpr double coincident = 2e-6;
// A drive that moves the crane's head by less than this in level direction cannot plumb it.
constexpr double least_head_motion = 1e-6;  // m per m or rad

/// What is left of an amount beyond a tolerance.
double beyond(double amount, double tolerance) {
  return std::copysign(std::max(0.0, std::abs(amount) - tolerance), amount);
}

Vector3 place(const Kinematics& kinematics, const BodyPoint& point) {
  return point_position(kinematics, point.body, point.p_BoQ_B);
}

}  // namespace

Steersman::Steersman(const LiftSystem& system) : system_(system), kinematics_(system.mechanism()) {
  const Mechanism& mechanism = system.mechanism();
  v_.setZero(mechanism.nv());
  if (!mechanism.loops().empty()) projector_.emplace(mechanism);
  for (const Steering& steering : system.operation().steerings()) {
    const auto* own = std::get_if<OwnLaw>(&steering.wish);
    helms_.push_back({{steering.start, steering.interval(), {0.0}},
                      static_cast<std::size_t>(steering.look_count()),
                      {},
                      {},
                      0.0,
                      own ? own->begin() : SpeedLaw()});
  }
}

bool Steersman::is_due(const Steering& steering, const Helm& helm, double t) const {
  const std::size_t looks = helm.asked.size();
  if (looks >= helm.look_count) return false;
  if (steering.stop_time && t >= *steering.stop_time - coincident) return false;
  return t >= steering.start + static_cast<double>(looks) * helm.course.interval - coincident;
}

bool Steersman::looks_at(double t) const {
  for (std::size_t i = 0; i < helms_.size(); ++i)
    if (is_due(system_.operation().steerings()[i], helms_[i], t)) return true;
  return false;
}

void Steersman::look(double t, LiftWorkspace& w) {
  for (std::size_t i = 0; i < helms_.size(); ++i) {
    const Steering& steering = system_.operation().steerings()[i];
    if (is_due(steering, helms_[i], t)) steer(steering, helms_[i], t, w.steered[i], w);
  }
}

std::vector<Course> Steersman::courses() const {
  std::vector<Course> courses;
  for (const Helm& helm : helms_) courses.push_back(helm.course);
  return courses;
}

// The travel that would fulfil the wish, less what is tolerated.
double Steersman::find_plumb_travel(const Steering& steering, const KeptPlumb& wish,
                                    const LiftWorkspace& w) {
  const Mechanism& mechanism = system_.mechanism();
  v_.setZero();
  v_[system_.operation().joint_drives()[steering.index].velocity_index] = 1.0;
  if (projector_) {
    projector_->look(w.q);
    projector_->project_velocities(v_);
  }
  compute_kinematics(mechanism, w.q, v_, kinematics_);
  const Eigen::Vector2d J =
      point_velocity(kinematics_, wish.head.body, wish.head.p_BoQ_B).head<2>();
  if (J.norm() < least_head_motion) return 0.0;
  const Vector3 d = place(w.kinematics, wish.target) - place(w.kinematics, wish.head);
  const double along = J.normalized().dot(d.head<2>());
  return beyond(along, steering.tolerance) / J.norm();
}

double Steersman::find_travel(const Steering& steering, Helm& helm, const LiftWorkspace& w) {
  const auto load = [&](int rope) -> const RopeLoad& { return w.rope_loads[rope]; };
  if (const auto* wish = std::get_if<KeptHeight>(&steering.wish)) {
    const double height =
        place(w.kinematics, wish->point).z() - place(w.kinematics, wish->reference).z();
    if (helm.asked.empty()) helm.difference = wish->difference.value_or(height);
    return beyond(height - helm.difference, steering.tolerance);
  }
  if (const auto* wish = std::get_if<KeptPlumb>(&steering.wish)) {
    return find_plumb_travel(steering, *wish, w);
  }
  if (const auto* wish = std::get_if<KeptTension>(&steering.wish)) {
    const RopeLoad& rope = load(wish->rope);
    return beyond(rope.tension - wish->tension, steering.tolerance) /
           wish->stiffness.value_or(rope.stiffness);
  }
  const auto& wish = std::get<KeptShare>(steering.wish);
  const RopeLoad& rope = load(wish.rope);
  double sum = rope.tension;
  for (const int other : wish.others) sum += load(other).tension;
  if (!(sum > 0.0)) return 0.0;
  return sum * beyond(rope.tension / sum - wish.share, steering.tolerance) /
         wish.stiffness.value_or(rope.stiffness);
}

double Steersman::find_seen(const Steering& steering, const Helm& helm, const Sight& sight,
                            double t, const LiftWorkspace& w) {
  const auto tension = [&](int rope) { return w.rope_loads[rope].tension; };
  if (const auto* seen = std::get_if<SeenHeight>(&sight))
    return place(w.kinematics, seen->point).z() - place(w.kinematics, seen->reference).z();
  if (const auto* seen = std::get_if<SeenPlumb>(&sight))
    return find_plumb_travel(steering, {seen->head, seen->target}, w);
  if (const auto* seen = std::get_if<SeenTension>(&sight)) return tension(seen->rope);
  if (const auto* seen = std::get_if<SeenShare>(&sight)) {
    double sum = tension(seen->rope);
    for (const int other : seen->others) sum += tension(other);
    return sum > 0.0 ? tension(seen->rope) / sum : 0.0;
  }
  const ProfileValue base = steering.base.evaluate(t);
  if (std::holds_alternative<SeenRate>(sight)) return base.velocity + helm.motion.speed;
  return base.position + helm.motion.travel;
}

// The speed that follows from what is seen now.
double Steersman::find_speed(const Steering& steering, Helm& helm, double t,
                             const LiftWorkspace& w) {
  const auto* own = std::get_if<OwnLaw>(&steering.wish);
  if (!own) return find_travel(steering, helm, w) / steering.correction_time;
  if (t >= steering.end - coincident) return 0.0;
  seen_.clear();
  for (const Sight& sight : own->sights) seen_.push_back(find_seen(steering, helm, sight, t, w));
  const double speed = helm.law(t, seen_);
  if (!std::isfinite(speed))
    throw SimulationError("law \"" + own->name + "\" gave drive \"" + steering.drive +
                          "\" the speed " + std::to_string(speed) + " at " + std::to_string(t) +
                          " s; it must give a finite one");
  return speed;
}

void Steersman::steer(const Steering& steering, Helm& helm, double t, MotionProfile& profile,
                      const LiftWorkspace& w) {
  const double h = helm.course.interval;
  helm.asked.push_back(find_speed(steering, helm, t, w));
  const auto looks = static_cast<int>(helm.asked.size());
  const int used = looks - 1 - steering.looks_behind();
  double wanted = 0.0;
  if (used >= 0 && t < steering.end - coincident) {
    wanted = std::clamp(helm.asked[used], -steering.limits.speed, steering.limits.speed);
  }
  const double from = steering.base.evaluate(t).position;
  // Would the drive stay within its range if it went for this speed and braked afterwards?
  const auto next = [&](double speed) {
    return advance(helm.motion, find_next_acceleration(helm.motion, speed, h, steering.limits), h);
  };
  const auto stays = [&](double speed) {
    SteeredMotion motion = next(speed);
    for (std::size_t k = 0; k < helm.look_count; ++k) {
      const double at = from + motion.travel;
      if ((at > steering.highest && speed > 0.0) || (at < steering.lowest && speed < 0.0))
        return false;
      if (std::abs(motion.speed) < 1e-9 * steering.limits.speed) break;
      motion = advance(motion, find_next_acceleration(motion, 0.0, h, steering.limits), h);
    }
    return true;
  };
  if (!stays(wanted)) {
    double good = 0.0, bad = wanted;
    for (int k = 0; k < 30; ++k) {
      const double middle = 0.5 * (good + bad);
      (stays(middle) ? good : bad) = middle;
    }
    wanted = good;
  }
  helm.motion = next(wanted);
  helm.course.accelerations.push_back(helm.motion.acceleration);
  profile = MotionProfile::along(helm.course);
  if (steering.stop_time)
    profile =
        MotionProfile::stopped(std::move(profile), *steering.stop_time, steering.stop_duration);
}

}  // namespace blocklift::dynamics
