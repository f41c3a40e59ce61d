#include "dynamics/simulation/wave_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blocklift::dynamics {
namespace {

constexpr long never = std::numeric_limits<long>::max();

/// The sea of the hulls and of what they scatter, which is one; null: there is none of many waves.
const Sea* find_sea_of_many_waves(const LiftSystem& system) {
  const auto has_many = [](const auto& force) {
    return force.definition().sea->waves.has_many_components();
  };
  for (const HullForce& hull : std::get<std::vector<HullForce>>(system.elements())) {
    if (hull.in_waves() && has_many(hull)) return hull.definition().sea.get();
  }
  for (const DiffractionForce& force : std::get<std::vector<DiffractionForce>>(system.elements())) {
    if (has_many(force)) return force.definition().sea.get();
  }
  return nullptr;
}

/// Of the sea's elevation in the square mean, that interpolation leaves.
double find_remainder(const WaveField& waves, double interval) {
  double error = 0.0, energy = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const WaveComponent wave = waves.component(c);
    const double share =
        std::min(1.0, ForecastForces::remainder * std::pow(wave.omega * interval, 6));
    error += std::pow(wave.amplitude * share, 2);
    energy += std::pow(wave.amplitude, 2);
  }
  return energy > 0.0 ? std::sqrt(error / energy) : 0.0;
}

/// At which a hull bobs that floats with half of its depth, rad/s.
double find_heave(const HullForce& hull) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3& vertex : hull.definition().hull->hull().vertices()) {
    low = std::min(low, vertex.z());
    high = std::max(high, vertex.z());
  }
  return std::sqrt(2.0 * hull.definition().sea->water().gravity / (high - low));
}

}  // namespace

WaveForecast::WaveForecast(const LiftSystem& system, double relative_tolerance)
    : system_(system),
      hulls_(std::get<std::vector<HullForce>>(system.elements())),
      others_(std::get<std::vector<DiffractionForce>>(system.elements())),
      share_(std::min(largest_share, std::sqrt(relative_tolerance))),
      kinematics_(system.mechanism()),
      q_(Eigen::VectorXd::Zero(system.mechanism().nq())),
      velocity_(Eigen::VectorXd::Zero(system.mechanism().nv())),
      largest_force_(hulls_.size() + others_.size(), 0.0),
      largest_moment_(largest_force_.size(), 0.0),
      standing_(largest_force_.size()) {
  const Sea* sea = find_sea_of_many_waves(system);
  if (sea == nullptr) return;
  interval_ = longest_interval;
  for (const HullForce& hull : hulls_) {
    const double heave = find_heave(hull);
    if (!hull.in_waves() || heave > fastest_heave) {
      standing_[planes_.size()].first = never;
    } else {
      interval_ = std::min(interval_, share_of_heave / heave);
    }
    planes_.emplace_back(hull.definition().hull->hull(), hull.definition().sea->waves);
  }
  if (std::ranges::all_of(standing_, [](const Standing& one) { return one.first == never; })) {
    interval_ = 0.0;  // all are found at each state
    return;
  }
  while (find_remainder(sea->waves, interval_) > tolerance) interval_ *= 0.95;
}

void WaveForecast::begin(double time, LiftWorkspace& w) {
  w.forecast = ForecastForces(interval_, hulls_.size(), others_.size());
  w.forecast.begin(time);
  for (std::size_t i = 0; i < standing_.size(); ++i) w.forecast.set_first(i, never);
  next_check_ = w.forecast.next();
}

bool WaveForecast::is_due(double time, double until, const LiftWorkspace& w) const {
  return w.forecast.before(until) + 1 >= w.forecast.next() ||
         w.forecast.before(time) >= next_check_;
}

bool WaveForecast::carry_on(double time, double until, LiftWorkspace& w) {
  ForecastForces& forecast = w.forecast;
  any_rests_ = false;
  if (forecast.before(time) >= next_check_) check(time, w);
  // Steps that are longer than instants ask for their forces but once or twice.
  if (until - time > 2.0 * interval_) {
    forecast.begin(until);
  } else {
    if (forecast.next() <= forecast.before(time)) forecast.begin(time);
    while (forecast.before(until) + 1 >= forecast.next())
      add_instant(forecast.time_of(forecast.next()) - time, w);
  }
  return any_rests_;
}

void WaveForecast::foresee(double ahead, const LiftWorkspace& w) {
  const Mechanism& mechanism = system_.mechanism();
  velocity_ = w.v + (0.5 * ahead) * w.vdot;
  mechanism.integrate(w.q, velocity_, ahead, q_);
  velocity_ = w.v + ahead * w.vdot;
  compute_kinematics(mechanism, q_, velocity_, kinematics_);
}

ForceVector WaveForecast::find_exact(std::size_t number, const MotionState& state) {
  const bool is_hull = number < hulls_.size();
  ForceVector F = is_hull ? hulls_[number].calc_force(state)
                          : others_[number - hulls_.size()].calc_force(state);
  const ForceVector by_waves = is_hull ? F - hulls_[number].calc_force(state, WaterPlane{}) : F;
  largest_force_[number] = std::max(largest_force_[number], by_waves.force.norm());
  largest_moment_[number] = std::max(largest_moment_[number], by_waves.moment.norm());
  return F;
}

void WaveForecast::add_instant(double ahead, LiftWorkspace& w) {
  ForecastForces& forecast = w.forecast;
  foresee(ahead, w);
  const double t = forecast.time_of(forecast.next());
  const MotionState state{t, q_, velocity_, kinematics_};
  const long instant = forecast.next();
  forecast.add();
  for (std::size_t i = 0; i < forecast.count(); ++i) {
    if (standing_[i].first > instant) continue;
    const ForceVector F = find_exact(i, state);
    if (i < hulls_.size()) {
      const WaterPlane plane = planes_[i].calc(t, kinematics_.X_WB[hulls_[i].definition().body]);
      forecast.set(i, plane, F - hulls_[i].calc_force(state, plane));
    } else {
      forecast.set(i, F);
    }
    judge(i, forecast.calc_error(i, standing_[i].first), t, w);
  }
}

void WaveForecast::check(double time, LiftWorkspace& w) {
  ForecastForces& forecast = w.forecast;
  compute_kinematics(system_.mechanism(), w.q, w.v, w.kinematics);
  const MotionState state{time, w.q, w.v, w.kinematics};
  forecast.interpolate(time);
  bool all_trusted = true;
  for (std::size_t i = 0; i < forecast.count(); ++i) {
    Standing& standing = standing_[i];
    if (forecast.has(standing.first, time)) {
      const ForceVector F =
          i < hulls_.size() ? forecast.calc_force(hulls_[i], i, state) : forecast.force(i);
      if (judge(i, F - find_exact(i, state), time, w)) ++standing.passed;
      if (standing.is_trusted()) forecast.set_first(i, standing.first);
    }
    all_trusted = all_trusted && (standing.is_trusted() || standing.first > forecast.next());
  }
  between_checks_ =
      all_trusted && !any_rests_ ? std::min(2 * between_checks_, instants_of_check) : 1;
  const long now = forecast.before(time);
  next_check_ = now + between_checks_;
  // One that has rested is checked as soon as it has its instants.
  for (const Standing& standing : standing_) {
    if (standing.is_trusted() || standing.first == never) continue;
    const long ready = standing.first + ForecastForces::through - 1;
    next_check_ = std::min(next_check_, std::max(now + 1, ready));
  }
}

bool WaveForecast::judge(std::size_t number, const ForceVector& error, double time,
                         LiftWorkspace& w) {
  if (error.force.norm() <= share_ * largest_force_[number] &&
      error.moment.norm() <= share_ * largest_moment_[number]) {
    return true;
  }
  Standing& standing = standing_[number];
  standing.first = w.forecast.before(time + standing.rest) + 1;
  if (standing.is_trusted()) {
    standing.rest *= 2.0;
    any_rests_ = true;
  }
  standing.passed = 0;
  w.forecast.set_first(number, never);
  return false;
}

}  // namespace blocklift::dynamics
