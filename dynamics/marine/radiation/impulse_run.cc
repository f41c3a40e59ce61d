#include "dynamics/marine/radiation/impulse_run.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "dynamics/marine/radiation/database_parts.h"
#include "parallel/blas_threads.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double tapered_fraction = 0.4;
constexpr Eigen::Index instants_together = 32;
// Of a run beside another one: the share of the longest stable step, and radians of the highest
// frequency, that its own longer step is at most.
constexpr double share_of_stable_step = 0.8, most_radians_of_step = 0.5;

/// Where the taper of a run of so many steps begins, if it is as long as was planned.
double taper_begin(long steps) { return (1.0 - tapered_fraction) * static_cast<double>(steps); }

/// 1 over the first part of the run, then half a cosine from `begin` down to 0 at its end.
double taper(long step, long steps, double begin) {
  const double fraction =
      (static_cast<double>(step) - begin) / (static_cast<double>(steps) - begin);
  return fraction <= 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fraction)));
}

MatrixXd symmetric_part(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

}  // namespace

double elevation_bytes(double unknowns, std::size_t frequencies) {
  const auto columns =
      static_cast<double>(4 * frequencies) + static_cast<double>(instants_together);
  return sizeof(double) * unknowns * columns;
}

ImpulseRun::ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
                       std::vector<double> frequencies, bool with_elevation)
    : part_(part),
      density_(water.density),
      gravity_(water.gravity),
      frequencies_(std::move(frequencies)),
      march_(part, damping, water.gravity, part.surface_columns().cols()),
      force_rows_(part.surface_columns().transpose()) {
  if (!with_elevation) return;
  const auto columns = static_cast<Eigen::Index>(2 * frequencies_.size());
  elevation_ = MatrixXd::Zero(part.surface_columns().size(), columns);
  instants_.resize(elevation_.rows(), instants_together);
  weights_.resize(instants_together, columns);
  whole_weights_.resize(instants_together, columns);
}

std::complex<double> ImpulseRun::wave(std::size_t frequency, long step) const {
  const double angle = 2.0 * std::asin(0.5 * frequencies_[frequency] * step_);
  return std::polar(1.0, -angle * static_cast<double>(step));
}

// What a run went through before it went on has been added to the integrals of the elevation in
// full: the taper of one that is three times as long or longer begins behind it.
double ImpulseRun::fade(long step) const {
  return taper(step, steps_, std::max(taper_begin(steps_), static_cast<double>(gone_)));
}

void ImpulseRun::accumulate(long step) {
  if (elevation_.size() == 0) return;
  const auto count = static_cast<Eigen::Index>(frequencies_.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::complex<double> factor = wave(static_cast<std::size_t>(k), step);
    whole_weights_(waiting_, k) = factor.real();
    whole_weights_(waiting_, count + k) = factor.imag();
  }
  whole_weights_.row(waiting_) *= weight(step);
  weights_.row(waiting_) = fade(step) * whole_weights_.row(waiting_);
  instants_.col(waiting_) = march_.elevation().reshaped();
  if (++waiting_ == instants_together) add_instants();
}

void ImpulseRun::add_instants() {
  if (waiting_ == 0) return;
  // Those that are not there have no weight, and what was there before is finite.
  instants_.rightCols(instants_together - waiting_).setZero();
  weights_.bottomRows(instants_together - waiting_).setZero();
  whole_weights_.bottomRows(instants_together - waiting_).setZero();
  multiply(1.0, instants_, weights_, 1.0, elevation_);
  if (whole_elevation_.size() > 0) {
    multiply(1.0, instants_, whole_weights_, 1.0, whole_elevation_);
  }
  waiting_ = 0;
}

void ImpulseRun::keep_whole() {
  if (whole_elevation_.size() == elevation_.size()) return;
  add_instants();
  whole_elevation_ = elevation_;
}

void ImpulseRun::go_on(long steps) {
  add_instants();
  elevation_.swap(whole_elevation_);
  whole_elevation_.resize(0, 0);
  gone_ = steps_;
  steps_ += steps;
}

void ImpulseRun::end() {
  add_instants();
  whole_elevation_.resize(0, 0);
}

void ImpulseRun::start(double step, long steps) {
  step_ = step;
  steps_ = steps;
  gone_ = 0;
  forces_.clear();
  elevation_.setZero();
  whole_elevation_.resize(0, 0);
  march_.start(part_.surface_columns(), step);
}

void ImpulseRun::keep_force() {
  const Eigen::Index modes = force_rows_.rows();
  MatrixXd force = MatrixXd::Zero(modes, modes);
  // The sum's order must not depend on the number of threads.
  const parallel::OneBlasThread for_a_small_product;
  multiply(density_ * gravity_, force_rows_, march_.elevation(), 0.0, force);
  forces_.push_back(symmetric_part(force));
}

double ImpulseRun::step_beside(double step) const {
  return std::max(step, std::min(share_of_stable_step * step_limit(),
                                 most_radians_of_step / frequencies_.back()));
}

void ImpulseRun::take_instant(long step, bool may_go_on) {
  if (may_go_on && fade(step) < 1.0) keep_whole();
  keep_force();
  accumulate(step);
}

long ImpulseRun::run(double step, const RunLength& length, ImpulseRun* beside,
                     const std::function<void(long, long)>& progress) {
  const double longer = beside != nullptr ? beside->step_beside(step) : step;
  // How many of the longer steps so many steps hold.
  const auto held = [&](long steps) {
    return static_cast<long>(static_cast<double>(steps) * step / longer * (1.0 + 1e-12));
  };
  start(step, length.steps);
  if (beside != nullptr) beside->start(longer, held(length.steps));
  long next = 0;  // instant of the run beside
  for (long k = 0;; ++k) {
    const bool may_go_on = steps_ < length.most * length.steps;
    const bool both = beside != nullptr && held(k) == next;
    take_instant(k, may_go_on);
    if (both) beside->take_instant(next++, may_go_on);
    if (progress) progress(k, steps_);
    if (k == steps_) {
      integrate_force(steps_);
      const VectorXd shares = largest_shares(cut_off_);
      if (!may_go_on || shares.size() == 0 || shares.maxCoeff() <= length.share) break;
      go_on(length.steps);
      if (beside != nullptr) beside->go_on(held(steps_) - beside->steps_);
    }
    const parallel::OneBlasThread for_marches_side_by_side;
    parallel::for_each(both ? 2 : 1, 0,
                       [&](int run) { (run == 0 ? *this : *beside).march_.advance(); });
  }
  end();
  if (beside == nullptr) return steps_;
  beside->end();
  beside->integrate_force(beside->steps_);
  return steps_;
}

MatrixXd ImpulseRun::retardation(long step) const {
  return part_.image_count() * fade(step) * forces_[static_cast<std::size_t>(step)];
}

double ImpulseRun::weight(long step) const { return (step == 0 ? 0.5 : 1.0) * step_; }

std::vector<MatrixXcd> ImpulseRun::integrate(long steps,
                                             const std::function<double(long)>& taper_of) const {
  const Eigen::Index modes = part_.surface_columns().cols();
  std::vector<MatrixXcd> integrals(frequencies_.size(), MatrixXcd::Zero(modes, modes));
  for (long n = 0; n <= steps; ++n) {
    const MatrixXd force = weight(n) * taper_of(n) * forces_[static_cast<std::size_t>(n)];
    for (std::size_t k = 0; k < integrals.size(); ++k) integrals[k] += wave(k, n) * force;
  }
  return integrals;
}

MatrixXd ImpulseRun::change_from(long steps) const {
  const std::vector<MatrixXcd> shorter =
      integrate(steps, [&](long n) { return taper(n, steps, taper_begin(steps)); });
  MatrixXd changes(part_.surface_columns().cols(), static_cast<Eigen::Index>(shorter.size()));
  for (std::size_t k = 0; k < shorter.size(); ++k) {
    changes.col(static_cast<Eigen::Index>(k)) =
        part_.image_count() * scale(k) * (force_[k] - shorter[k]).diagonal().cwiseAbs();
  }
  return changes;
}

void ImpulseRun::integrate_force(long steps) {
  steps_ = steps;
  force_ = integrate(steps, [this](long n) { return fade(n); });
  estimate_cut();
}

void ImpulseRun::estimate_cut() {
  const auto three_fifths = [](long all) { return static_cast<long>(taper_begin(all)); };
  const long shorter = three_fifths(steps_), shortest = three_fifths(shorter);
  cut_off_ = change_from(shorter);
  const VectorXd last = largest_shares(cut_off_), before = largest_shares(change_from(shortest));
  for (Eigen::Index m = 0; m < cut_off_.rows(); ++m) {
    const double q = before[m] > 0.0 ? std::pow(last[m] / before[m], 5.0 / 3.0) : 0.0;
    if (q < 0.5) cut_off_.row(m) *= q / (1.0 - q);
  }
}

VectorXd ImpulseRun::largest_shares(const MatrixXd& amounts) const {
  const MatrixXd unmoved = density_ * part_.infinite_frequency_volume();
  MatrixXcd forces(amounts.rows(), amounts.cols());
  for (std::size_t k = 0; k < frequencies_.size(); ++k) {
    auto column = forces.col(static_cast<Eigen::Index>(k));
    column.real() = damping(k).diagonal();
    column.imag() = frequencies_[k] * (unmoved + added_mass(k)).diagonal();
  }
  return largest_share(part_.modes(), forces, amounts);
}

double ImpulseRun::scale(std::size_t frequency) const {
  const double half_angle = 0.5 * frequencies_[frequency] * step_;
  return 1.0 / std::sqrt(1.0 - half_angle * half_angle);
}

MatrixXd ImpulseRun::damping(std::size_t frequency) const {
  return part_.image_count() * scale(frequency) * force_[frequency].real();
}

MatrixXd ImpulseRun::added_mass(std::size_t frequency) const {
  return part_.image_count() * scale(frequency) / frequencies_[frequency] *
         force_[frequency].imag();
}

MatrixXcd ImpulseRun::elevation(std::size_t frequency) const {
  const MatrixXd& q = part_.surface_columns();
  const auto real = static_cast<Eigen::Index>(frequency);
  const auto imaginary = real + static_cast<Eigen::Index>(frequencies_.size());
  MatrixXcd elevation(q.rows(), q.cols());
  elevation.real() = scale(frequency) * elevation_.col(real).reshaped(q.rows(), q.cols());
  elevation.imag() = scale(frequency) * elevation_.col(imaginary).reshaped(q.rows(), q.cols());
  return elevation;
}

}  // namespace blocklift::dynamics
