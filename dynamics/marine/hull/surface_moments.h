#pragma once

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Integrals over a piece of surface with the unit normal n, p being the place in the body's frame:
///
///   N_i = int n_i dA,   Q_ij = int n_i p_j dA,   T_ijk = int n_i p_j p_k dA     (m2, m3, m4).
///
/// By Gauss' theorem all that still water does to a hull follows from those of its wetted surface
/// (hydrostatics.h): they add up piece by piece, and do not change while the piece stays wet.
struct SurfaceMoments {
  Vector3 N = Vector3::Constant(not_a_number);
  Matrix3 Q = Matrix3::Constant(not_a_number);
  /// Columns xx, xy, xz, yy, yz, zz of the last two indices.
  Eigen::Matrix<double, 3, 6> T = Eigen::Matrix<double, 3, 6>::Constant(not_a_number);

  static SurfaceMoments zero() {
    return {Vector3::Zero(), Matrix3::Zero(), Eigen::Matrix<double, 3, 6>::Zero()};
  }

  SurfaceMoments& operator+=(const SurfaceMoments& other) {
    N += other.N;
    Q += other.Q;
    T += other.T;
    return *this;
  }

  /// Adds a triangle; counter-clockwise seen from the side to which n points. Exact.
  void add_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 n = 0.5 * (b - a).cross(c - a);
    const Vector3 s = a + b + c;
    Eigen::Matrix<double, 1, 6> second;
    second << a.x() * a.x() + b.x() * b.x() + c.x() * c.x() + s.x() * s.x(),
        a.x() * a.y() + b.x() * b.y() + c.x() * c.y() + s.x() * s.y(),
        a.x() * a.z() + b.x() * b.z() + c.x() * c.z() + s.x() * s.z(),
        a.y() * a.y() + b.y() * b.y() + c.y() * c.y() + s.y() * s.y(),
        a.y() * a.z() + b.y() * b.z() + c.y() * c.z() + s.y() * s.z(),
        a.z() * a.z() + b.z() * b.z() + c.z() * c.z() + s.z() * s.z();
    N += n;
    Q.noalias() += n * (s.transpose() * (1.0 / 3.0));
    T.noalias() += n * (second * (1.0 / 12.0));
  }

  /// The symmetric matrix sum_i a_i T_ijk.
  Matrix3 contract(const Vector3& a) const {
    const Eigen::Matrix<double, 1, 6> w = a.transpose() * T;
    Matrix3 m;
    m << w[0], w[1], w[2], w[1], w[3], w[4], w[2], w[4], w[5];
    return m;
  }
  /// The matrix sum_k T_ijk a_k: row i, column j.
  Matrix3 apply(const Vector3& a) const {
    Matrix3 m;
    m.col(0) = T.col(0) * a.x() + T.col(1) * a.y() + T.col(2) * a.z();
    m.col(1) = T.col(1) * a.x() + T.col(3) * a.y() + T.col(4) * a.z();
    m.col(2) = T.col(2) * a.x() + T.col(4) * a.y() + T.col(5) * a.z();
    return m;
  }
};

}  // namespace blocklift::dynamics
