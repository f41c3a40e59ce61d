#pragma once

#include "dynamics/spatial/spatial_vector.h"

namespace blocklift::dynamics {

/// Symmetric 3x3 matrix by its six numbers.
struct Symmetric3 {
  double xx = not_a_number;
  double xy = not_a_number;
  double xz = not_a_number;
  double yy = not_a_number;
  double yz = not_a_number;
  double zz = not_a_number;

  static Symmetric3 zero() { return {0, 0, 0, 0, 0, 0}; }
  /// Takes the upper triangle.
  static Symmetric3 of(const Matrix3& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  }
  Matrix3 matrix() const {
    Matrix3 m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }
  double trace() const { return xx + yy + zz; }

  Symmetric3& operator+=(const Symmetric3& b) {
    xx += b.xx, xy += b.xy, xz += b.xz, yy += b.yy, yz += b.yz, zz += b.zz;
    return *this;
  }
  /// Adds s a a^T.
  void add_outer(double s, const Vector3& a) {
    const double sx = s * a.x();
    const double sy = s * a.y();
    xx += sx * a.x(), xy += sx * a.y(), xz += sx * a.z();
    yy += sy * a.y(), yz += sy * a.z(), zz += s * a.z() * a.z();
  }
  Vector3 operator*(const Vector3& a) const {
    return {xx * a.x() + xy * a.y() + xz * a.z(), xy * a.x() + yy * a.y() + yz * a.z(),
            xz * a.x() + yz * a.y() + zz * a.z()};
  }
};

/// R S R^T: a symmetric tensor given in B, expressed in A by R_AB.
inline Symmetric3 rotate(const Matrix3& R_AB, const Symmetric3& S_B) {
  const Vector3 row0 = S_B * R_AB.row(0).transpose();
  const Vector3 row1 = S_B * R_AB.row(1).transpose();
  const Vector3 row2 = S_B * R_AB.row(2).transpose();
  return {R_AB.row(0).dot(row0), R_AB.row(0).dot(row1), R_AB.row(0).dot(row2),
          R_AB.row(1).dot(row1), R_AB.row(1).dot(row2), R_AB.row(2).dot(row2)};
}

/// Mass properties of a rigid body B in its own frame.
struct RigidBodyInertia {
  double mass = not_a_number;                         ///< kg
  Vector3 p_BoBcm = Vector3::Constant(not_a_number);  ///< centre of mass from Bo, in B, m
  Symmetric3 I_BBcm;                                  ///< about the centre of mass, in B, kg m2

  static RigidBodyInertia zero() { return {0, Vector3::Zero(), Symmetric3::zero()}; }

  /// Momentum of the body about Bo when Bo and B move with V (expressed in B): I V.
  ForceVector operator*(const MotionVector& V) const;
  /// Kinetic energy at V_WB expressed in B, J.
  double kinetic_energy(const MotionVector& V) const { return 0.5 * dot(*this * V, V); }
};

/// The same body's properties in a frame A in which B has the pose X_AB.
RigidBodyInertia transform(const Pose& X_AB, const RigidBodyInertia& inertia_B);

/// Two bodies rigidly joined, both given in one frame.
RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b);

/// Any symmetric 6x6 inertia about a point, by its three blocks:
///   moment = J angular + H linear,   force = H^T angular + M linear.
/// Rigid bodies, composite and articulated bodies and added mass all have this form.
struct SpatialInertia {
  Symmetric3 J;                                 ///< angular-angular, kg m2
  Matrix3 H = Matrix3::Constant(not_a_number);  ///< angular-linear, kg m
  Symmetric3 M;                                 ///< linear-linear, kg

  static SpatialInertia zero() { return {Symmetric3::zero(), Matrix3::Zero(), Symmetric3::zero()}; }
  /// A rigid body's inertia about Bo (Featherstone 2008, eq. 2.63).
  static SpatialInertia of(const RigidBodyInertia& body);

  SpatialInertia& operator+=(const SpatialInertia& other) {
    J += other.J;
    H += other.H;
    M += other.M;
    return *this;
  }
  ForceVector operator*(const MotionVector& V) const {
    return {J * V.angular + H * V.linear, H.transpose() * V.angular + M * V.linear};
  }
  /// (angular; linear) 6x6 matrix.
  Eigen::Matrix<double, 6, 6> matrix() const;
};

/// The same inertia expressed in the axes of A, about the same point.
SpatialInertia rotate(const Matrix3& R_AB, const SpatialInertia& inertia_B);

/// Adds to `inertia_P` (about P) the inertia `inertia_Q` given about Q, both rigidly joined; p_PQ
/// in their common axes. With r = p_PQ:  M' = M,  H' = H + [r]x M,  J' = J - H [r]x + [r]x H'^T.
inline void add_shifted(const SpatialInertia& inertia_Q, const Vector3& p_PQ,
                        SpatialInertia& inertia_P) {
  const Vector3& r = p_PQ;
  const Symmetric3& M = inertia_Q.M;
  const Matrix3& H = inertia_Q.H;
  // H' = H + [r]x M, row by row.
  const double h00 = H(0, 0) + r.y() * M.xz - r.z() * M.xy;
  const double h01 = H(0, 1) + r.y() * M.yz - r.z() * M.yy;
  const double h02 = H(0, 2) + r.y() * M.zz - r.z() * M.yz;
  const double h10 = H(1, 0) + r.z() * M.xx - r.x() * M.xz;
  const double h11 = H(1, 1) + r.z() * M.xy - r.x() * M.yz;
  const double h12 = H(1, 2) + r.z() * M.xz - r.x() * M.zz;
  const double h20 = H(2, 0) + r.x() * M.xy - r.y() * M.xx;
  const double h21 = H(2, 1) + r.x() * M.yy - r.y() * M.xy;
  const double h22 = H(2, 2) + r.x() * M.yz - r.y() * M.xz;
  // J' = J + [r]x H'^T - H [r]x, upper triangle; (H [r]x)_ij = (row i of H) x r . e_j.
  const auto row_cross_x = [&](int i) { return H(i, 1) * r.z() - H(i, 2) * r.y(); };
  const auto row_cross_y = [&](int i) { return H(i, 2) * r.x() - H(i, 0) * r.z(); };
  const auto row_cross_z = [&](int i) { return H(i, 0) * r.y() - H(i, 1) * r.x(); };
  inertia_P.J.xx += inertia_Q.J.xx + r.y() * h02 - r.z() * h01 - row_cross_x(0);
  inertia_P.J.xy += inertia_Q.J.xy + r.y() * h12 - r.z() * h11 - row_cross_y(0);
  inertia_P.J.xz += inertia_Q.J.xz + r.y() * h22 - r.z() * h21 - row_cross_z(0);
  inertia_P.J.yy += inertia_Q.J.yy + r.z() * h10 - r.x() * h12 - row_cross_y(1);
  inertia_P.J.yz += inertia_Q.J.yz + r.z() * h20 - r.x() * h22 - row_cross_z(1);
  inertia_P.J.zz += inertia_Q.J.zz + r.x() * h21 - r.y() * h20 - row_cross_z(2);
  Matrix3& G = inertia_P.H;
  G(0, 0) += h00, G(0, 1) += h01, G(0, 2) += h02;
  G(1, 0) += h10, G(1, 1) += h11, G(1, 2) += h12;
  G(2, 0) += h20, G(2, 1) += h21, G(2, 2) += h22;
  inertia_P.M += M;
}

}  // namespace blocklift::dynamics
