#include "dynamics/marine/loads/surface_range.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blocklift::dynamics {
namespace {

using Counts = std::array<std::size_t, 3>;

/// Points along each side that are no farther apart than `spacing`, both ends among them.
Counts count_points(const Vector3& half_extent, double spacing) {
  Counts counts;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    counts[axis] = 1 + static_cast<std::size_t>(std::ceil(2.0 * half_extent[axis] / spacing));
  }
  return counts;
}

std::size_t product(const Counts& counts) { return counts[0] * counts[1] * counts[2]; }

double find_spacing(const Vector3& half_extent) {
  double spacing = 2.0 * half_extent.maxCoeff();
  while (product(count_points(half_extent, 0.97 * spacing)) <= SurfaceRange::most_points) {
    spacing *= 0.97;
  }
  return spacing;
}

/// Standard deviation of what waves do between points a diagonal apart, m.
double calc_unseen_deviation(const WaveField& waves, double diagonal) {
  double sum = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const double share = std::min(1.0, std::pow(waves.wave_number(c) * diagonal, 2) / 8.0);
    sum += 0.5 * std::pow(waves.component(c).amplitude * share, 2);
  }
  return std::sqrt(sum);
}

}  // namespace

SurfaceRange::SurfaceRange(const Vector3& centre, const Vector3& half_extent,
                           const WaveField& waves) {
  if (!waves.has_many_components() || !(half_extent.maxCoeff() > 0.0)) return;
  const double spacing = find_spacing(half_extent);
  const Counts counts = count_points(half_extent, spacing);
  const auto share = [](std::size_t i, std::size_t count) {
    if (count == 1) return 0.0;
    return 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0;
  };
  for (std::size_t i = 0; i < counts[0]; ++i) {
    for (std::size_t j = 0; j < counts[1]; ++j) {
      for (std::size_t k = 0; k < counts[2]; ++k) {
        const Vector3 place(share(i, counts[0]), share(j, counts[1]), share(k, counts[2]));
        points_B_.emplace_back(centre + half_extent.cwiseProduct(place));
      }
    }
  }
  // Of the two sides of a cell that lie level, in most attitudes.
  margin_ = deviations * calc_unseen_deviation(waves, std::sqrt(2.0) * spacing);
}

SurfaceRange::Range SurfaceRange::calc_range(double time, const Pose& X_WB,
                                             const WaveField& waves) const {
  const double ramp = waves.ramp().factor(time);
  const double most = waves.highest_elevation() * ramp;
  if (points_B_.empty()) return {-most, most};
  std::array<double, most_points> x, y, elevation;
  for (std::size_t i = 0; i < points_B_.size(); ++i) {
    const Vector3 place = X_WB.apply(points_B_[i]);
    x[i] = place.x();
    y[i] = place.y();
  }
  waves.calc_elevations(time, points_B_.size(), x.data(), y.data(), elevation.data());
  const auto end = elevation.begin() + static_cast<std::ptrdiff_t>(points_B_.size());
  const auto [low, high] = std::minmax_element(elevation.begin(), end);
  return {std::max(-most, *low - ramp * margin_), std::min(most, *high + ramp * margin_)};
}

}  // namespace blocklift::dynamics
