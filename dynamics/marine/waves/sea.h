#pragma once

#include "dynamics/marine/waves/current.h"
#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// The water around floating bodies: calm surface at z = 0 of the world, waves, current.
struct Sea {
  WaveField waves;
  Current current;

  const Water& water() const { return waves.water(); }
  /// Velocity of the water at a point: waves and current, m/s.
  Vector3 calc_velocity(double time, const Vector3& p_W) const {
    Vector3 velocity = current.calc_velocity(p_W.z());
    if (!waves.is_still()) velocity += waves.calc_velocity(time, p_W);
    return velocity;
  }
  /// Height of the surface above a point of z = 0, m.
  double calc_elevation(double time, double x, double y) const {
    return waves.is_still() ? 0.0 : waves.calc_elevation(time, x, y);
  }
  /// The same water at rest but for its current: for static equilibrium.
  Sea without_waves() const { return {WaveField(waves.water()), current}; }
};

}  // namespace blocklift::dynamics
