#include "dynamics/marine/radiation/impulse_run.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

constexpr double tapered_fraction = 0.4;
constexpr Eigen::Index instants_together = 32;

/// 1 over the first part of the run, then half a cosine down to 0 at its end.
double taper(long step, long steps) {
  const double begin = (1.0 - tapered_fraction) * static_cast<double>(steps);
  const double fraction =
      (static_cast<double>(step) - begin) / (static_cast<double>(steps) - begin);
  return fraction <= 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fraction)));
}

MatrixXd symmetric_part(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

}  // namespace

double elevation_bytes(double unknowns, std::size_t frequencies) {
  const auto columns =
      static_cast<double>(2 * frequencies) + static_cast<double>(instants_together);
  return sizeof(double) * unknowns * columns;
}

ImpulseRun::ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
                       std::vector<double> frequencies, bool with_elevation)
    : part_(part),
      density_(water.density),
      gravity_(water.gravity),
      frequencies_(std::move(frequencies)),
      march_(part, damping, water.gravity, part.surface_columns().cols()) {
  if (!with_elevation) return;
  const auto columns = static_cast<Eigen::Index>(2 * frequencies_.size());
  elevation_ = MatrixXd::Zero(part.surface_columns().size(), columns);
  instants_.resize(elevation_.rows(), instants_together);
  weights_.resize(instants_together, columns);
}

void ImpulseRun::accumulate(long step, double weight, const MatrixXd& force) {
  const auto count = static_cast<Eigen::Index>(frequencies_.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const double angle = 2.0 * std::asin(0.5 * frequencies_[k] * step_) * static_cast<double>(step);
    const std::complex<double> factor = weight * std::polar(1.0, -angle);
    force_[k] += factor * force;
    if (elevation_.size() == 0) continue;
    weights_(waiting_, k) = factor.real();
    weights_(waiting_, count + k) = factor.imag();
  }
  if (elevation_.size() == 0) return;
  instants_.col(waiting_) = march_.elevation().reshaped();
  if (++waiting_ == instants_together) add_instants();
}

void ImpulseRun::add_instants() {
  if (waiting_ == 0) return;
  // Those that are not there have no weight, and what was there before is finite.
  instants_.rightCols(instants_together - waiting_).setZero();
  weights_.bottomRows(instants_together - waiting_).setZero();
  multiply(1.0, instants_, weights_, 1.0, elevation_);
  waiting_ = 0;
}

void ImpulseRun::run(double step, long steps, const Receiver& receive) {
  step_ = step;
  const MatrixXd& q = part_.surface_columns();
  force_.assign(frequencies_.size(), Eigen::MatrixXcd::Zero(q.cols(), q.cols()));
  elevation_.setZero();
  const double factor = density_ * gravity_;
  march_.start(q, step);
  for (long k = 0;; ++k) {
    const double reduction = taper(k, steps);
    const MatrixXd force = symmetric_part(factor * (q.transpose() * march_.elevation()));
    receive(k, part_.image_count() * reduction * force);
    accumulate(k, (k == 0 ? 0.5 : 1.0) * step * reduction, force);
    if (k == steps) break;
    march_.advance();
  }
  add_instants();
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

Eigen::MatrixXcd ImpulseRun::elevation(std::size_t frequency) const {
  const MatrixXd& q = part_.surface_columns();
  const auto real = static_cast<Eigen::Index>(frequency);
  const auto imaginary = real + static_cast<Eigen::Index>(frequencies_.size());
  Eigen::MatrixXcd elevation(q.rows(), q.cols());
  elevation.real() = scale(frequency) * elevation_.col(real).reshaped(q.rows(), q.cols());
  elevation.imag() = scale(frequency) * elevation_.col(imaginary).reshaped(q.rows(), q.cols());
  return elevation;
}

}  // namespace blocklift::dynamics
