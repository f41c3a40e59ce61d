#pragma once

#include <vector>

#include "dynamics/marine/hull/hull.h"
#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// Water whose surface is a plane about a hull, at height + slope . ((x, y) - place), and whose
/// pressure is rho g times the height of that surface above a point.
struct WaterPlane {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m
  double height = 0.0;                              ///< of the surface there, m
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// The plane that waves make about a hull.
///
/// Elevation and slope at the middle of the hull's extent, each wave with the share
///
///   exp(-k^2 r^2 / 2),   r^2 = (a^2 + b^2) / 12,   a and b the hull's length and breadth,
///
/// which is what a cosine has in the mean over points that scatter by r: waves that are much longer
/// than the hull count in full, those that are shorter hardly. Immutable.
class WaterPlaneOfWaves {
 public:
  WaterPlaneOfWaves(const Hull& hull, const WaveField& waves);

  /// At a time (s), the hull being at this pose. Does not allocate.
  WaterPlane calc(double time, const Pose& X_WB) const;

 private:
  struct Wave {
    double amplitude, kx, ky, omega, phase;
  };
  WaveRamp ramp_;
  Vector3 p_BoM_B_;  ///< the middle, m
  std::vector<Wave> waves_;
};

}  // namespace blocklift::dynamics
