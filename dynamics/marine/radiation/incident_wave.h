#pragma once

#include <complex>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// Complex amplitudes of a regular wave of unit amplitude: each quantity is Re(amplitude e^{i w
/// t}), with the elevation eta = Re exp(i (w t - k (x cos theta + y sin theta))). The paper's
/// equation (28), with cosh(k (z + h))/cosh(k h) for exp(k z) in water of finite depth.
class IncidentWave {
 public:
  /// Frequency in rad/s, heading in rad (direction of travel, from +x towards +y).
  IncidentWave(const Water& water, double frequency, double heading);

  double wave_number() const { return wave_number_; }
  std::complex<double> elevation(const Vector3& p_W) const;  ///< m per m
  std::complex<double> potential(const Vector3& p_W) const;  ///< m2/s per m
  Eigen::Vector3cd velocity(const Vector3& p_W) const;       ///< m/s per m

 private:
  Water water_;
  double frequency_, wave_number_, cosine_, sine_;
};

}  // namespace blocklift::dynamics
