#include "dynamics/marine/radiation/impulse_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

constexpr double tapered_fraction = 0.4;

/// 1 over the first part of the run, then half a cosine down to 0 at its end.
double taper(long step, long steps) {
  const double begin = (1.0 - tapered_fraction) * static_cast<double>(steps);
  const double fraction =
      (static_cast<double>(step) - begin) / (static_cast<double>(steps) - begin);
  return fraction <= 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fraction)));
}

MatrixXd symmetric_part(const MatrixXd& matrix) { return 0.5 * (matrix + matrix.transpose()); }

}  // namespace

ImpulseRun::ImpulseRun(const RankinePart& part, const SurfaceDamping& damping, const Water& water,
                       std::vector<double> frequencies)
    : part_(part),
      density_(water.density),
      gravity_(water.gravity),
      frequencies_(std::move(frequencies)),
      march_(part, damping, water.gravity, part.surface_columns().cols()) {}

void ImpulseRun::accumulate(double time, double weight) {
  for (std::size_t k = 0; k < frequencies_.size(); ++k) {
    const double angle = 2.0 / step_ * std::asin(0.5 * frequencies_[k] * step_) * time;
    cosine_[k] += weight * std::cos(angle) * march_.elevation();
    sine_[k] -= weight * std::sin(angle) * march_.elevation();
  }
}

void ImpulseRun::run(double step, long steps, const Receiver& receive) {
  step_ = step;
  const MatrixXd& q = part_.surface_columns();
  cosine_.assign(frequencies_.size(), MatrixXd::Zero(q.rows(), q.cols()));
  sine_ = cosine_;
  const double factor = density_ * gravity_ * part_.image_count();
  march_.start(q, step);
  for (long k = 0;; ++k) {
    const double reduction = taper(k, steps);
    receive(k, symmetric_part(factor * reduction * (q.transpose() * march_.elevation())));
    accumulate(static_cast<double>(k) * step, (k == 0 ? 0.5 : 1.0) * step * reduction);
    if (k == steps) break;
    march_.advance();
  }
}

double ImpulseRun::scale(std::size_t frequency) const {
  const double half_angle = 0.5 * frequencies_[frequency] * step_;
  return 1.0 / std::sqrt(1.0 - half_angle * half_angle);
}

MatrixXd ImpulseRun::damping(std::size_t frequency) const {
  const double factor = density_ * gravity_ * part_.image_count() * scale(frequency);
  return symmetric_part(factor * (part_.surface_columns().transpose() * cosine_[frequency]));
}

MatrixXd ImpulseRun::added_mass(std::size_t frequency) const {
  const double factor = density_ * gravity_ * part_.image_count() * scale(frequency);
  return symmetric_part(factor / frequencies_[frequency] *
                        (part_.surface_columns().transpose() * sine_[frequency]));
}

Eigen::MatrixXcd ImpulseRun::elevation(std::size_t frequency) const {
  Eigen::MatrixXcd elevation(cosine_[frequency].rows(), cosine_[frequency].cols());
  elevation.real() = scale(frequency) * cosine_[frequency];
  elevation.imag() = scale(frequency) * sine_[frequency];
  return elevation;
}

}  // namespace blocklift::dynamics
