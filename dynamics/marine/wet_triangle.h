#pragma once

#include <array>
#include <cstddef>

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// A corner of a wetted triangle.
struct WetPoint {
  Vector3 r;    ///< place from the origin that moments are about, m
  double head;  ///< pressure over rho g, m
};

/// Adds -int h n dA and -int r x n h dA of a triangle whose head h is linear between its corners; n points
/// to the side from which they run counter-clockwise.
inline void add_wet_triangle(const WetPoint& a, const WetPoint& b, const WetPoint& c,
                             ForceVector& F) {
  const Vector3 n = 0.5 * (b.r - a.r).cross(c.r - a.r);
  const double sum = a.head + b.head + c.head;
  F.force -= sum / 3.0 * n;
  const Vector3 arm = (a.head + sum) * a.r + (b.head + sum) * b.r + (c.head + sum) * c.r;
  F.moment -= (arm / 12.0).cross(n);
}

/// The place on the edge from a to b where the height above the water, ha and hb, is zero.
inline WetPoint at_surface(const WetPoint& a, double ha, const WetPoint& b, double hb) {
  return {a.r + ha / (ha - hb) * (b.r - a.r), 0.0};
}

/// The same of the part of a triangle that lies below the water. Does not allocate.
/// @param p corners. @param h their heights above the water's surface, m, linear between them.
inline void add_wet_part(const std::array<WetPoint, 3>& p, const std::array<double, 3>& h,
                         ForceVector& F) {
  const int wet = (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
  if (wet == 0) return;
  if (wet == 3) {
    add_wet_triangle(p[0], p[1], p[2], F);
    return;
  }
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const WetPoint ij = at_surface(p[i], h[i], p[j], h[j]);
  const WetPoint ik = at_surface(p[i], h[i], p[k], h[k]);
  if (wet == 1) {
    add_wet_triangle(p[i], ij, ik, F);
  } else {
    add_wet_triangle(ij, p[j], p[k], F);
    add_wet_triangle(ij, p[k], ik, F);
  }
}

}  // namespace blocklift::dynamics
