#pragma once

#include <array>

#include "structure/stress_tensor.h"

namespace blocklift::structure {

/// Weld toe whose structural stress is asked for, on the surface of a plate.
struct HotSpot {
  Vector3 toe = Vector3::Zero();         ///< m
  Vector3 direction = Vector3::UnitX();  ///< away from the weld along the surface, unit
  double thickness = 0;                  ///< t of the plate, m

  /// The two places that the stress is read at: 0.4 t and 1.0 t before the toe.
  std::array<Vector3, 2> places() const {
    return {toe + 0.4 * thickness * direction, toe + thickness * direction};
  }
};

/// Structural stress at a weld toe, extrapolated linearly: 1.67 sigma(0.4 t) - 0.67 sigma(1.0 t),
/// each component. Source: Hobbacher (2016), Recommendations for fatigue design of welded joints
/// and components, IIW-2259-15, section 2.2.3.4, type a, fine mesh (there written with these
/// rounded factors; exact ones, 5/3 and 2/3, are taken, so that a linear stress is met exactly).
template <class Stresses>
auto hot_spot_stress(const Stresses& at_04_t, const Stresses& at_10_t) {
  return (5.0 / 3 * at_04_t - 2.0 / 3 * at_10_t).eval();
}

/// What counts of a structural stress for fatigue at the toe.
struct HotSpotStress {
  double normal = 0;     ///< across the weld: d . sigma d, Pa
  double principal = 0;  ///< of largest magnitude, Pa
  double angle = 0;      ///< between its direction and d, rad, 0 to pi/2
  /// The principal stress if it acts within 60 degrees of d, else the one across the weld (IIW,
  /// 2.2.3).
  double governing = 0;
};

HotSpotStress evaluate_hot_spot(const Stress& structural, const Vector3& direction);

/// n . sigma n as a row for stresses (xx, yy, zz, xy, yz, zx).
Eigen::Matrix<double, 1, 6> normal_component(const Vector3& n);

}  // namespace blocklift::structure
