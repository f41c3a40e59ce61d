#include "dynamics/marine/loads/water_plane.h"

#include <cmath>

namespace blocklift::dynamics {

WaterPlaneOfWaves::WaterPlaneOfWaves(const Hull& hull, const WaveField& waves)
    : ramp_(waves.ramp()) {
  Eigen::AlignedBox3d extent;
  for (const Vector3& vertex : hull.vertices()) extent.extend(vertex);
  p_BoM_B_ = extent.center();
  const double square = extent.sizes().head<2>().squaredNorm() / 12.0;
  constexpr double negligible = 1e-9;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const WaveComponent wave = waves.component(c);
    const double k = waves.wave_number(c);
    const double share = std::exp(-0.5 * k * k * square);
    if (share < negligible) continue;
    waves_.push_back({share * wave.amplitude, k * std::cos(wave.heading),
                      k * std::sin(wave.heading), wave.omega, wave.phase});
  }
}

WaterPlane WaterPlaneOfWaves::calc(double time, const Pose& X_WB) const {
  WaterPlane plane;
  plane.place = X_WB.apply(p_BoM_B_).head<2>();
  for (const Wave& wave : waves_) {
    const double theta =
        wave.kx * plane.place.x() + wave.ky * plane.place.y() - wave.omega * time + wave.phase;
    plane.height += wave.amplitude * std::cos(theta);
    plane.slope -= wave.amplitude * std::sin(theta) * Eigen::Vector2d(wave.kx, wave.ky);
  }
  const double factor = ramp_.factor(time);
  plane.height *= factor;
  plane.slope *= factor;
  return plane;
}

}  // namespace blocklift::dynamics
