#pragma once

#include <array>
#include <cstddef>

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// Adds -int q dA n and -int p x n q dA of a wet triangle, the pressure q over rho g (m) being linear between
/// its corners p (m, from the origin that moments are about). `area`: n times its area, m2.
inline void add_wet_triangle(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& q,
                             const Vector3& area, ForceVector& F) {
  const double sum = q[0] + q[1] + q[2];
  const Vector3 arm = (q[0] + sum) * *p[0] + (q[1] + sum) * *p[1] + (q[2] + sum) * *p[2];
  F.force -= sum / 3.0 * area;
  F.moment -= (arm / 12.0).cross(area);
}

/// The same of what is wet of a triangle that the surface cuts, h being the heights of its corners above the
/// water (m) and `wet` the number of those below; q falls to zero at the surface. Does not allocate.
inline void add_cut_triangle(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
                             const std::array<double, 3>& q, int wet, const Vector3& area,
                             ForceVector& F) {
  // The corner that is alone on its side comes first; the order round the triangle is kept.
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const double to_j = h[i] / (h[i] - h[j]);
  const double to_k = h[i] / (h[i] - h[k]);
  const Vector3 ij = *p[i] + to_j * (*p[j] - *p[i]);
  const Vector3 ik = *p[i] + to_k * (*p[k] - *p[i]);
  double sum;   // of q over the corners of each wet piece, times its share of the area
  Vector3 arm;  // 12 int p q dA over the area
  if (wet == 1) {
    const double share = to_j * to_k;
    sum = share * q[i];
    arm = sum * (2.0 * *p[i] + ij + ik);
  } else {
    // The triangles (ij, j, k) and (ij, k, ik).
    const double share = 1.0 - to_j, rest = to_j * (1.0 - to_k);
    const double both = share * (q[j] + q[k]), upper = rest * q[k];
    sum = both + upper;
    arm = both * (ij + *p[j] + *p[k]) + share * (q[j] * *p[j] + q[k] * *p[k]) +
          upper * (ij + 2.0 * *p[k] + ik);
  }
  F.force -= sum / 3.0 * area;
  F.moment -= (arm / 12.0).cross(area);
}

/// The same of any triangle: dry, wet or cut.
inline void add_wet_part(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
                         const std::array<double, 3>& q, const Vector3& area, ForceVector& F) {
  const int wet = (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
  if (wet == 3) {
    add_wet_triangle(p, q, area, F);
  } else if (wet > 0) {
    add_cut_triangle(p, h, q, wet, area, F);
  }
}

}  // namespace blocklift::dynamics
