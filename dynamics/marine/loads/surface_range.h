#pragma once

#include <vector>

#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// Between what heights waves stand about a hull at an instant.
///
/// Of few components: plus and minus the sum of their amplitudes. Of many, which never come
/// together: the lowest and highest of their elevations at a lattice of points through the box
/// around the hull, and a margin for what may stand between these. A component sags by (k d)^2/8 of
/// its amplitude over a cell of the diagonal d, or is not seen at all; the margin is four standard
/// deviations of the sum of that. Beyond it the surface lies for some 1e-4 of the time, by little:
/// what is taken for wet there has then a pressure a little below zero. Immutable.
class SurfaceRange {
 public:
  static constexpr std::size_t most_points = 256;
  static constexpr double deviations = 4.0;

  struct Range {
    double low, high;  ///< above z = 0, m
  };

  /// Box around a hull, in B, m.
  SurfaceRange(const Vector3& centre, const Vector3& half_extent, const WaveField& waves);

  /// `waves` as above. Does not allocate.
  Range calc_range(double time, const Pose& X_WB, const WaveField& waves) const;

 private:
  std::vector<Vector3> points_B_;  ///< none: the sum of the amplitudes
  double margin_ = 0.0;            ///< m
};

}  // namespace blocklift::dynamics
