#pragma once

#include <limits>

#include <Eigen/Dense>

namespace blocklift::dynamics {

using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix3 = Eigen::Matrix3d;

/// Read-only and writable views of state-sized vectors; a contiguous array never gets copied.
using ConstVectorRef = const Eigen::Ref<const Eigen::VectorXd>&;
using VectorRef = Eigen::Ref<Eigen::VectorXd>;

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Pose X_AB of a frame B seen from a frame A: rotation R_AB and position p_AoBo_A (m).
/// A point Q fixed in B has the position  p_AoQ_A = p_AoBo_A + R_AB p_BoQ_B.
struct Pose {
  Matrix3 R = Matrix3::Constant(not_a_number);  ///< R_AB: columns are the axes of B expressed in A
  Vector3 p = Vector3::Constant(not_a_number);  ///< p_AoBo expressed in A, m

  static Pose identity() { return {Matrix3::Identity(), Vector3::Zero()}; }
  /// Pose of a frame that is displaced by p and not turned.
  static Pose translation(const Vector3& p) { return {Matrix3::Identity(), p}; }

  /// X_BA.
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
  /// Position in A of a point given in B, m.
  Vector3 apply(const Vector3& p_BoQ_B) const { return p + R * p_BoQ_B; }
};

/// X_AC = X_AB X_BC.
inline Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.R * X_BC.R, X_AB.apply(X_BC.p)};
}

/// The matrix [a]x with [a]x b = a x b.
Matrix3 skew(const Vector3& a);

/// Rotation by an angle (rad) about a unit axis, right-handed (Rodrigues' formula).
Matrix3 rotation_about(const Vector3& unit_axis, double angle);

/// Rotation of a quaternion (w, x, y, z) of any length but zero: the length is divided out, so that
/// a quaternion that has drifted off the unit sphere still gives an orthogonal matrix.
Matrix3 rotation_from_quaternion(const Vector4& quaternion);

/// Unit quaternion (w, x, y, z) of a rotation, with w >= 0.
Vector4 quaternion_from_rotation(const Matrix3& R);

/// Hamilton product a b: the rotation of b followed by that of a.
Vector4 quaternion_product(const Vector4& a, const Vector4& b);

/// Unit quaternion of a rotation vector (axis times angle, rad); accurate down to the angle zero.
Vector4 quaternion_exponential(const Vector3& rotation_vector);

/// Rotation vector (rad, length at most pi) of a quaternion of any length but zero.
Vector3 rotation_vector(const Vector4& quaternion);

/// Rate of a quaternion that orients B in A, from the angular velocity w_AB expressed in B (rad/s):
/// dQ/dt = 1/2 Q (0, w_AB_B).  It keeps the length of the quaternion.
Vector4 quaternion_rate(const Vector4& quaternion, const Vector3& w_AB_B);

}  // namespace blocklift::dynamics
