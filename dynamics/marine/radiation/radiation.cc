#include "dynamics/marine/radiation/radiation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/incident_wave.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr std::array<double, 3> gauss_points = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> gauss_weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

}  // namespace

MemoryConvolution::MemoryConvolution(const HydrodynamicDatabase& database)
    : step_(database.time_step), samples_(database.retardation) {
  if (samples_.size() < 4 || !(step_ > 0.0)) {
    throw ModelError("a convolution needs retardation functions at four instants at least");
  }
  memory_ = step_ * static_cast<double>(samples_.size() - 1);
  kernel_ = MatrixXd::Zero(samples_[0].rows(), samples_[0].cols());
  value_ = VectorXd::Zero(samples_[0].rows());
  for (std::size_t cell = 0; cell + 1 < samples_.size(); ++cell) {
    for (const double point : gauss_points) {
      interpolate_kernel((static_cast<double>(cell) + point) * step_);
      gauss_.push_back(kernel_);
    }
  }
}

void MemoryConvolution::interpolate_kernel(double lag) const {
  const double position = lag / step_;
  const auto last = static_cast<long>(samples_.size()) - 1;
  const long cell = std::clamp(static_cast<long>(std::floor(position)), 0L, last - 1);
  const double s = position - static_cast<double>(cell);
  // Lagrange's cubic through the four samples about the cell; K is even about zero.
  const auto sample = [&](long k) -> const MatrixXd& {
    return samples_[k < 0 ? -k : std::min(k, last)];
  };
  kernel_ = (-s * (s - 1.0) * (s - 2.0) / 6.0) * sample(cell - 1) +
            ((s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0) * sample(cell) +
            (-(s + 1.0) * s * (s - 2.0) / 2.0) * sample(cell + 1) +
            ((s + 1.0) * s * (s - 1.0) / 6.0) * sample(cell + 2);
}

void MemoryConvolution::start(double time, const VectorXd& velocity, const VectorXd& acceleration) {
  history_.clear();
  history_.push_back({time, velocity, acceleration});
}

void MemoryConvolution::record(double time, const VectorXd& velocity,
                               const VectorXd& acceleration) {
  if (history_.empty() || !(time > history_.back().time)) {
    throw ModelError("the history of a convolution must be started, and its instants ascend; " +
                     std::to_string(time) + " s does not follow");
  }
  history_.push_back({time, velocity, acceleration});
  // Now and then drop what no force can see any more.
  std::size_t old = 0;
  while (old + 2 < history_.size() && history_[old + 1].time < time - memory_) ++old;
  if (old > 1000 && 2 * old > history_.size()) {
    history_.erase(history_.begin(), history_.begin() + static_cast<std::ptrdiff_t>(old));
  }
}

/// Velocity at a past instant into value_; `instant` walks backwards through the history.
void MemoryConvolution::interpolate(double time, double now, const VectorXd& velocity_now,
                                    std::size_t& instant) const {
  while (instant > 0 && history_[instant].time > time) --instant;
  const Instant& from = history_[instant];
  if (instant + 1 == history_.size()) {
    // Beyond the last instant: the parabola through it, with its slope, and the present velocity.
    const double h = now - from.time;
    const double s = h > 0.0 ? (time - from.time) / h : 0.0;
    value_ = (1.0 - s * s) * from.velocity + (s * (1.0 - s) * h) * from.acceleration +
             (s * s) * velocity_now;
    return;
  }
  const Instant& to = history_[instant + 1];
  const double h = to.time - from.time, s = (time - from.time) / h;
  value_ = ((1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s)) * from.velocity +
           (h * s * (1.0 - s) * (1.0 - s)) * from.acceleration +
           (s * s * (3.0 - 2.0 * s)) * to.velocity + (h * s * s * (s - 1.0)) * to.acceleration;
}

void MemoryConvolution::calc_force(double time, const VectorXd& velocity, VectorXd& force) const {
  force.setZero(kernel_.rows());
  const double reach = std::min(memory_, time - history_.front().time);
  std::size_t instant = history_.size() - 1;
  const auto whole = static_cast<std::size_t>(std::max(0.0, std::floor(reach / step_ + 1e-12)));
  for (std::size_t cell = 0; cell < whole && cell + 1 < samples_.size(); ++cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double lag = (static_cast<double>(cell) + gauss_points[k]) * step_;
      interpolate(time - lag, time, velocity, instant);
      force.noalias() -= (step_ * gauss_weights[k]) * (gauss_[3 * cell + k] * value_);
    }
  }
  // The cell in which the motion started, up to there.
  const double from = static_cast<double>(whole) * step_;
  if (reach <= from || whole + 1 >= samples_.size()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const double lag = from + gauss_points[k] * (reach - from);
    interpolate(time - lag, time, velocity, instant);
    interpolate_kernel(lag);
    force.noalias() -= ((reach - from) * gauss_weights[k]) * (kernel_ * value_);
  }
}

namespace {

/// Over the first two periods of the longest wave.
WaveRamp slow_ramp(const std::vector<RegularWave>& waves) {
  double longest = 0.0;
  for (const RegularWave& wave : waves) {
    longest = std::max(longest, 2.0 * std::numbers::pi / wave.frequency);
  }
  return {0.0, 2.0 * longest};
}

}  // namespace

DirectRadiation::DirectRadiation(const PanelModel& model, const Settings& settings)
    : waves_(settings.waves),
      ramp_(settings.ramp.value_or(slow_ramp(settings.waves))),
      with_froude_krylov_(settings.with_froude_krylov),
      origin_(settings.origin),
      infinite_added_mass_(MatrixXd::Zero(model.mode_count(), model.mode_count())) {
  RankineSettings rankine = settings.rankine;
  rankine.keep_factors = !waves_.empty();
  const Water& water = model.water();
  const SurfaceDamping damping =
      DampingZone{settings.damping_strength, settings.lids}.damping(model.surface(), water.gravity);
  for (const Parity& parity : model.parities()) {
    if (model.normal_velocities(parity).isZero(0.0)) continue;
    RankinePart part(model, parity, rankine);
    const auto& modes = part.modes();
    const MatrixXd share = water.density * part.infinite_frequency_volume();
    infinite_added_mass_(modes, modes) += 0.5 * (share + share.transpose());
    FreeSurfaceMarch march(part, damping, water.gravity, 1);
    const double factor = water.density * water.gravity * part.image_count();
    parts_.push_back({std::move(part), std::move(march), factor, {}});
  }
  for (const WettedBody& body : model.bodies()) {
    mean_reference_ += Vector3(body.reference_point.x(), body.reference_point.y(), 0.0) /
                       static_cast<double>(model.body_count());
  }
  way_ = mean_reference_.head<2>();
  if (!waves_.empty()) prepare_grid(model);
}

// Over a step of the grid no wave changes its phase at any panel by more than a fifth of a radian,
// so that what is linear between two turns is off by a two-hundredth.
void DirectRadiation::prepare_grid(const PanelModel& model) {
  constexpr double most_phase = 0.2;
  model_ = std::make_shared<const PanelModel>(model);
  double reach = 0.0, highest = 0.0;
  for (const WettedBody& body : model.bodies()) {
    for (const Panel& panel : body.hull.panels) {
      reach = std::max(reach, (panel.centroid - mean_reference_).head<2>().norm());
    }
  }
  for (const RegularWave& wave : waves_) {
    const double wave_number = calc_wave_number(wave.frequency, model.water());
    highest = std::max(highest, wave_number);
    wave_vector_.emplace_back(wave_number *
                              Eigen::Vector2d(std::cos(wave.heading), std::sin(wave.heading)));
  }
  turn_count_ =
      std::max(72, static_cast<int>(std::ceil(whole_turn * highest * reach / most_phase)));
  keep_columns();
}

DirectRadiation::WaveColumns DirectRadiation::make_columns(const RankinePart& part,
                                                           int turn) const {
  const Complex i(0.0, 1.0);
  const PanelModel& model = *model_;
  const Parity& parity = part.parity();
  const auto count = static_cast<Eigen::Index>(waves_.size());
  const Eigen::Index panels = model.body_areas().size();
  Eigen::MatrixXcd potential(panels, count);
  MatrixXd velocities(panels, 2 * count), bodies, supply;
  for (Eigen::Index k = 0; k < count; ++k) {
    const RegularWave& regular = waves_[k];
    const IncidentWave wave(model.water(), regular.frequency,
                            regular.heading - whole_turn * turn / turn_count_);
    potential.col(k) =
        (i * regular.frequency) * model.part_of(parity, [&](const Vector3& p, const Vector3&) {
          return wave.potential(p - mean_reference_);
        });
    const Eigen::VectorXcd opposed =
        model.part_of(parity, [&](const Vector3& p, const Vector3& n) -> Complex {
          return -(wave.velocity(p - mean_reference_).transpose() * n)(0);
        });
    velocities.col(2 * k) = opposed.real();
    velocities.col(2 * k + 1) = opposed.imag();
  }
  part.solve(velocities, bodies, supply);
  const MatrixXd weighted = model.water().density * part.image_count() *
                            (model.body_areas().asDiagonal() * part.normal_velocities());
  WaveColumns columns;
  columns.force = weighted.transpose() * potential;
  columns.supply.resize(supply.rows(), count);
  columns.potential.resize(weighted.cols(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    columns.supply.col(k) =
        supply.col(2 * k).cast<Complex>() + i * supply.col(2 * k + 1).cast<Complex>();
    columns.potential.col(k) = weighted.transpose() * (bodies.col(2 * k).cast<Complex>() +
                                                       i * bodies.col(2 * k + 1).cast<Complex>());
  }
  return columns;
}

void DirectRadiation::keep_columns() {
  constexpr std::size_t most_kept = 16;
  const auto apart = [&](int turn) {
    const int way = std::abs(turn - turn_.before);
    return std::min(way, turn_count_ - way);
  };
  for (Part& part : parts_) {
    for (const int turn : {turn_.before, turn_.after}) {
      if (!part.waves.contains(turn)) part.waves.emplace(turn, make_columns(part.rankine, turn));
    }
    while (part.waves.size() > most_kept) {
      part.waves.erase(std::max_element(
          part.waves.begin(), part.waves.end(),
          [&](const auto& a, const auto& b) { return apart(a.first) < apart(b.first); }));
    }
  }
}

VectorXd DirectRadiation::sum(const Part& part, Eigen::MatrixXcd WaveColumns::*columns,
                              const Eigen::VectorXcd& values) const {
  VectorXd total = (part.waves.at(turn_.before).*columns * values).real();
  if (turn_.share == 0.0) return total;
  return (1.0 - turn_.share) * total +
         turn_.share * (part.waves.at(turn_.after).*columns * values).real();
}

void DirectRadiation::carry(const Eigen::Vector2d& place, double turn) {
  way_ = place - origin_;
  if (waves_.empty()) return;
  const double along = turn / whole_turn * turn_count_;
  const double before = std::floor(along);
  const auto on_grid = [&](double position) {
    const int index = static_cast<int>(std::fmod(position, turn_count_));
    return index < 0 ? index + turn_count_ : index;
  };
  turn_ = {on_grid(before), on_grid(along > before ? before + 1.0 : before), along - before};
  keep_columns();
}

double DirectRadiation::step_limit() const {
  double limit = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) limit = std::min(limit, part.march.step_limit());
  return limit;
}

void DirectRadiation::start(double step) {
  step_ = step;
  time_ = 0.0;
  for (Part& part : parts_) {
    part.march.start(MatrixXd::Zero(part.rankine.surface_columns().rows(), 1), step);
  }
}

Eigen::VectorXcd DirectRadiation::amplitudes(double time) const {
  Eigen::VectorXcd values(static_cast<Eigen::Index>(waves_.size()));
  const double factor = ramp_.factor(time);
  for (std::size_t k = 0; k < waves_.size(); ++k) {
    const double phase = waves_[k].frequency * time - wave_vector_[k].dot(way_);
    values[k] = factor * std::polar(1.0, phase) * waves_[k].amplitude;
  }
  return values;
}

// What the bodies' own way adds to the rate is of second order.
Eigen::VectorXcd DirectRadiation::amplitude_rates(double time) const {
  constexpr double beside = 1e-3;
  const double factor = ramp_.factor(time);
  const double growth = (ramp_.factor(time + beside) - ramp_.factor(time - beside)) / (2 * beside);
  Eigen::VectorXcd rates(static_cast<Eigen::Index>(waves_.size()));
  for (std::size_t k = 0; k < waves_.size(); ++k) {
    const double phase = waves_[k].frequency * time - wave_vector_[k].dot(way_);
    rates[k] = Complex(growth, factor * waves_[k].frequency) * std::polar(1.0, phase) *
               waves_[k].amplitude;
  }
  return rates;
}

VectorXd DirectRadiation::calc_force() const {
  VectorXd force = VectorXd::Zero(infinite_added_mass_.rows());
  for (const Part& part : parts_) {
    VectorXd share = -part.force_factor *
                     (part.rankine.surface_columns().transpose() * part.march.elevation().col(0));
    if (!waves_.empty()) {
      share += sum(part, &WaveColumns::potential, amplitude_rates(time_));
      if (with_froude_krylov_) share += sum(part, &WaveColumns::force, amplitudes(time_));
    }
    force(part.rankine.modes()) += share;
  }
  return force;
}

void DirectRadiation::advance(const VectorXd& velocity) {
  const double middle = time_ + 0.5 * step_;
  for (Part& part : parts_) {
    MatrixXd supply = part.rankine.surface_columns() * velocity(part.rankine.modes());
    if (!waves_.empty()) supply += sum(part, &WaveColumns::supply, amplitudes(middle));
    part.march.advance(supply);
  }
  time_ += step_;
}

}  // namespace blocklift::dynamics
