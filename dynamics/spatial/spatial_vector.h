#pragma once

#include "dynamics/spatial/pose.h"

namespace blocklift::dynamics {

/// Spatial velocity or acceleration of a body at a point: (angular; linear), as Featherstone (2008)
/// orders them. V_WB_W: angular velocity of B in W (rad/s) and velocity of Bo (m/s), both expressed
/// in W. Accelerations A_WB are the ordinary ones (rad/s2; m/s2): the linear part is the
/// acceleration of Bo.
struct MotionVector {
  Vector3 angular = Vector3::Constant(not_a_number);
  Vector3 linear = Vector3::Constant(not_a_number);

  static MotionVector zero() { return {Vector3::Zero(), Vector3::Zero()}; }
};

/// Spatial force on a body about a point: (moment; force), N m and N.
struct ForceVector {
  Vector3 moment = Vector3::Constant(not_a_number);
  Vector3 force = Vector3::Constant(not_a_number);

  static ForceVector zero() { return {Vector3::Zero(), Vector3::Zero()}; }

  ForceVector& operator+=(const ForceVector& other) {
    moment += other.moment;
    force += other.force;
    return *this;
  }
};

inline MotionVector operator+(const MotionVector& a, const MotionVector& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}
inline MotionVector operator-(const MotionVector& a, const MotionVector& b) {
  return {a.angular - b.angular, a.linear - b.linear};
}
inline MotionVector operator*(double s, const MotionVector& a) {
  return {s * a.angular, s * a.linear};
}
inline ForceVector operator+(const ForceVector& a, const ForceVector& b) {
  return {a.moment + b.moment, a.force + b.force};
}
inline ForceVector operator-(const ForceVector& a, const ForceVector& b) {
  return {a.moment - b.moment, a.force - b.force};
}
inline ForceVector operator*(double s, const ForceVector& a) { return {s * a.moment, s * a.force}; }

/// Power (W) of a force on a motion, both at one point and in one frame.
inline double dot(const ForceVector& F, const MotionVector& V) {
  return F.moment.dot(V.angular) + F.force.dot(V.linear);
}

/// Spatial cross product of two motions at one point, V x S (Featherstone 2008, eq. 2.31).
inline MotionVector cross(const MotionVector& V, const MotionVector& S) {
  return {V.angular.cross(S.angular), V.angular.cross(S.linear) + V.linear.cross(S.angular)};
}

/// Dual cross product of a motion and a force at one point, V x* F (Featherstone 2008, eq. 2.32).
inline ForceVector cross_dual(const MotionVector& V, const ForceVector& F) {
  return {V.angular.cross(F.moment) + V.linear.cross(F.force), V.angular.cross(F.force)};
}

/// Velocity of the same body at the point Q from that at the point P; p_PQ in the frame of V.
inline MotionVector shift(const MotionVector& V_P, const Vector3& p_PQ) {
  return {V_P.angular, V_P.linear + V_P.angular.cross(p_PQ)};
}

/// The same force about the point P, given about the point Q; p_PQ in the frame of F.
inline ForceVector shift_to(const ForceVector& F_Q, const Vector3& p_PQ) {
  return {F_Q.moment + p_PQ.cross(F_Q.force), F_Q.force};
}

/// A motion given at Bo in B, seen at Ao in A: the Pluecker transform of X_AB (Featherstone
/// eq. 2.24).
inline MotionVector transform(const Pose& X_AB, const MotionVector& V_B) {
  const Vector3 angular = X_AB.R * V_B.angular;
  return {angular, X_AB.R * V_B.linear + X_AB.p.cross(angular)};
}

/// A force given about Bo in B, seen about Ao in A (Featherstone 2008, eq. 2.25).
inline ForceVector transform(const Pose& X_AB, const ForceVector& F_B) {
  const Vector3 force = X_AB.R * F_B.force;
  return {X_AB.R * F_B.moment + X_AB.p.cross(force), force};
}

}  // namespace blocklift::dynamics
