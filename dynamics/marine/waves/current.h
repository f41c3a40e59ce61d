#pragma once

#include <vector>

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Steady level current with a profile over the depth.
///
/// Above the calm water line the value at the line goes on, so that a wave crest moves with it.
class Current {
 public:
  /// Velocity at one height.
  struct Level {
    double z = not_a_number;        ///< m, not above 0
    double speed = not_a_number;    ///< m/s
    double heading = not_a_number;  ///< direction of flow, rad from +x towards +y
  };

  /// No current.
  Current() = default;
  /// The velocity is linear between levels and constant beyond them.
  /// @throws ModelError if a number is not finite, a speed negative, or a level above the water or
  ///   given twice.
  explicit Current(std::vector<Level> levels);

  /// The same at all depths.
  static Current uniform(double speed, double heading);
  /// Tidal current: speed at the surface times ((h + z)/h)^(1/7), by 12 levels that lie closer
  /// towards the bottom, at most 1.5 % of the surface's speed off the power law.
  /// Source: DNV-RP-C205, 4.1.4. @throws ModelError if the depth is not positive and finite.
  static Current tidal(double speed, double heading, double depth);
  /// Current driven by the wind: speed at the surface times (d + z)/d down to the depth d (50 m are
  /// usual), none below. Source: DNV-RP-C205, 4.1.4.
  static Current wind_driven(double speed, double heading, double reach = 50.0);

  bool is_none() const { return z_.empty(); }
  /// Velocity of the water at a height, m/s.
  Vector3 calc_velocity(double z) const;

 private:
  std::vector<double> z_;  ///< ascending
  std::vector<Vector3> velocity_;
};

}  // namespace blocklift::dynamics
