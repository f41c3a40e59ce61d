#include "dynamics/marine/radiation/far_field.h"

#include <cmath>
#include <numbers>

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

constexpr double full_circle = 2.0 * std::numbers::pi;
// Beyond the phase over the bodies the harmonics of a far field fall off faster than any power.
constexpr int harmonics_beyond = 12;

}  // namespace

DirectionalWaves::DirectionalWaves(const Eigen::VectorXcd& values)
    : order_(static_cast<int>((values.size() - 1) / 2)),
      coefficients_(Eigen::VectorXcd::Zero(2 * order_ + 1)) {
  const auto count = static_cast<double>(values.size());
  for (int m = -order_; m <= order_; ++m) {
    for (Eigen::Index j = 0; j < values.size(); ++j) {
      coefficients_[m + order_] +=
          values[j] * std::polar(1.0 / count, m * full_circle * static_cast<double>(j) / count);
    }
  }
}

Complex DirectionalWaves::at(double direction) const {
  Complex sum = 0.0;
  for (int m = -order_; m <= order_; ++m) {
    sum += coefficients_[m + order_] * std::polar(1.0, -m * direction);
  }
  return sum;
}

Complex DirectionalWaves::slope(double direction) const {
  Complex sum = 0.0;
  for (int m = -order_; m <= order_; ++m) {
    sum += Complex(0.0, -m) * coefficients_[m + order_] * std::polar(1.0, -m * direction);
  }
  return sum;
}

DirectionalWaves::Moments DirectionalWaves::integrate() const {
  Moments moments{full_circle * coefficients_.squaredNorm(), 0.0, 0.0};
  // The first harmonic of |H|^2 comes from neighbours.
  Complex neighbours = 0.0;
  for (Eigen::Index k = 0; k + 1 < coefficients_.size(); ++k) {
    neighbours += coefficients_[k] * std::conj(coefficients_[k + 1]);
  }
  moments.along_x = full_circle * neighbours.real();
  moments.along_y = -full_circle * neighbours.imag();
  return moments;
}

double DirectionalWaves::integrate_turning() const {
  double sum = 0.0;
  for (int m = -order_; m <= order_; ++m) sum += m * std::norm(coefficients_[m + order_]);
  return full_circle * sum;
}

int direction_count(double reach, double wave_number) {
  return 2 * (static_cast<int>(std::ceil(reach * wave_number)) + harmonics_beyond) + 1;
}

}  // namespace blocklift::dynamics
