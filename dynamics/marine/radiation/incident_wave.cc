#include "dynamics/marine/radiation/incident_wave.h"

#include <cmath>

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

/// cosh(k (z + h))/cosh(k h) and sinh(k (z + h))/cosh(k h), without overflow.
std::array<double, 2> decay(const Water& water, double k, double z) {
  if (is_deep(water)) return {std::exp(k * z), std::exp(k * z)};
  const double down = std::exp(-2.0 * k * (z + water.depth));
  const double scale = std::exp(k * z) / (1.0 + std::exp(-2.0 * k * water.depth));
  return {scale * (1.0 + down), scale * (1.0 - down)};
}

}  // namespace

IncidentWave::IncidentWave(const Water& water, double frequency, double heading)
    : water_(water),
      frequency_(frequency),
      wave_number_(calc_wave_number(frequency, water)),
      cosine_(std::cos(heading)),
      sine_(std::sin(heading)) {}

Complex IncidentWave::elevation(const Vector3& p_W) const {
  return std::polar(1.0, -wave_number_ * (p_W.x() * cosine_ + p_W.y() * sine_));
}

Complex IncidentWave::potential(const Vector3& p_W) const {
  const double amplitude = water_.gravity / frequency_ * decay(water_, wave_number_, p_W.z())[0];
  return Complex(0.0, amplitude) * elevation(p_W);
}

Eigen::Vector3cd IncidentWave::velocity(const Vector3& p_W) const {
  const auto [level, upright] = decay(water_, wave_number_, p_W.z());
  const Complex scale = Complex(0.0, water_.gravity / frequency_ * wave_number_) * elevation(p_W);
  const Complex along = Complex(0.0, -1.0) * level * scale;
  return {along * cosine_, along * sine_, upright * scale};
}

}  // namespace blocklift::dynamics
