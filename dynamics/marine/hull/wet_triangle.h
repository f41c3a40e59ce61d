#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// Adds -int q dA n and -int p x n q dA of a wet triangle, the pressure q over rho g (m) being
/// linear between its corners p (m, from the origin that moments are about). `area`: n times its
/// area, m2.
inline void add_wet_triangle(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& q,
                             const Vector3& area, ForceVector& F) {
  const double sum = q[0] + q[1] + q[2];
  const Vector3 arm = (q[0] + sum) * *p[0] + (q[1] + sum) * *p[1] + (q[2] + sum) * *p[2];
  F.force -= sum / 3.0 * area;
  F.moment -= (arm / 12.0).cross(area);
}

/// A triangle that the surface cuts. The corner that is alone on its side comes first; the order
/// round the triangle is kept.
struct TriangleCut {
  std::size_t i, j, k;  ///< corners
  double to_j, to_k;    ///< how far from i the surface is met, as shares of the edges
  Vector3 ij, ik;       ///< where

  /// h: heights of the corners above the water (m); `wet`: number of those below, 1 or 2.
  TriangleCut(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h, int wet)
      : i(0) {
    while ((h[i] < 0.0) != (wet == 1)) ++i;
    j = (i + 1) % 3;
    k = (i + 2) % 3;
    to_j = h[i] / (h[i] - h[j]);
    to_k = h[i] / (h[i] - h[k]);
    ij = *p[i] + to_j * (*p[j] - *p[i]);
    ik = *p[i] + to_k * (*p[k] - *p[i]);
  }
};

/// How many corners lie below the surface.
inline int count_wet(const std::array<double, 3>& h) {
  return (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
}

/// The same of what is wet of a triangle that the surface cuts, h being the heights of its corners
/// above the water (m) and `wet` the number of those below; q falls to zero at the surface. Does
/// not allocate.
inline void add_cut_triangle(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
                             const std::array<double, 3>& q, int wet, const Vector3& area,
                             ForceVector& F) {
  const auto [i, j, k, to_j, to_k, ij, ik] = TriangleCut(p, h, wet);
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
  const int wet = count_wet(h);
  if (wet == 3) {
    add_wet_triangle(p, q, area, F);
  } else if (wet > 0) {
    add_cut_triangle(p, h, q, wet, area, F);
  }
}

/// Points at which a pressure that is not linear is to be known, to be integrated over what is wet
/// of triangles: three inside each wet piece, exact to the second degree (Strang and Fix 1973).
/// Does not allocate.
template <std::size_t most_pieces>
class WetTrianglePoints {
 public:
  static constexpr std::size_t most = 3 * most_pieces;

  std::size_t count() const { return count_; }
  std::span<const Vector3> points() const { return {points_.data(), count_}; }
  /// What a point stands for: n dA, m2.
  const Vector3& area(std::size_t point) const { return areas_[point / 3]; }

  /// As add_wet_part: up to two pieces.
  void add_wet_part(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
                    const Vector3& area) {
    const int wet = count_wet(h);
    if (wet == 0) return;
    if (wet == 3) {
      add(*p[0], *p[1], *p[2], area);
      return;
    }
    const auto [i, j, k, to_j, to_k, ij, ik] = TriangleCut(p, h, wet);
    if (wet == 1) {
      add(*p[i], ij, ik, to_j * to_k * area);
    } else {
      add(ij, *p[j], *p[k], (1.0 - to_j) * area);
      add(ij, *p[k], ik, to_j * (1.0 - to_k) * area);
    }
  }

 private:
  void add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& area) {
    const Vector3 sixth = (a + b + c) / 6.0;
    areas_[count_ / 3] = area / 3.0;
    for (const Vector3* corner : {&a, &b, &c}) points_[count_++] = sixth + 0.5 * *corner;
  }

  std::array<Vector3, most> points_;
  std::array<Vector3, most_pieces> areas_;
  std::size_t count_ = 0;
};

}  // namespace blocklift::dynamics
