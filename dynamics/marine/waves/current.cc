#include "dynamics/marine/waves/current.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

Current::Current(std::vector<Level> levels) {
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.z < b.z; });
  for (const Level& level : levels) {
    const bool sound = std::isfinite(level.z) && std::isfinite(level.heading) &&
                       std::isfinite(level.speed) && level.speed >= 0.0 && level.z <= 0.0;
    if (!sound) {
      throw ModelError("the current has the speed " + std::to_string(level.speed) +
                       " m/s towards " + std::to_string(level.heading) +
                       " rad at z = " + std::to_string(level.z) +
                       " m; a speed from zero at a height not above zero is due");
    }
    if (!z_.empty() && z_.back() == level.z) {
      throw ModelError("the current has two speeds at z = " + std::to_string(level.z) + " m");
    }
    z_.push_back(level.z);
    velocity_.push_back(level.speed *
                        Vector3(std::cos(level.heading), std::sin(level.heading), 0.0));
  }
}

Current Current::uniform(double speed, double heading) { return Current({{0.0, speed, heading}}); }

Current Current::tidal(double speed, double heading, double depth) {
  if (!(depth > 0.0) || !std::isfinite(depth)) {
    throw ModelError("a tidal current has the depth " + std::to_string(depth) +
                     " m; a finite number above zero is due");
  }
  // Heights whose speeds are evenly spaced: (h + z)/h = s^7.
  constexpr int count = 11;
  std::vector<Level> levels;
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    levels.push_back({i == count ? 0.0 : depth * (std::pow(s, 7) - 1.0), speed * s, heading});
  }
  return Current(std::move(levels));
}

Current Current::wind_driven(double speed, double heading, double reach) {
  if (!(reach > 0.0) || !std::isfinite(reach)) {
    throw ModelError("a wind-driven current reaches down " + std::to_string(reach) +
                     " m; a finite number above zero is due");
  }
  return Current({{-reach, 0.0, heading}, {0.0, speed, heading}});
}

Vector3 Current::calc_velocity(double z) const {
  if (z_.empty()) return Vector3::Zero();
  if (z <= z_.front()) return velocity_.front();
  if (z >= z_.back()) return velocity_.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(z_.begin(), z_.end(), z) - z_.begin());
  const double share = (z - z_[next - 1]) / (z_[next] - z_[next - 1]);
  return velocity_[next - 1] + share * (velocity_[next] - velocity_[next - 1]);
}

}  // namespace blocklift::dynamics
