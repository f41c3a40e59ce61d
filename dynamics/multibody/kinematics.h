#pragma once

#include <vector>

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics {

/// Where every body is and how it moves: workspace and result of compute_kinematics.
///
/// Per body, the world (index 0) included. Velocities are expressed in W and taken at Bo: the
/// angular velocity of the body and the ordinary velocity of its origin.
struct Kinematics {
  explicit Kinematics(const Mechanism& mechanism);

  std::vector<Pose> X_WB;          ///< pose of each body
  std::vector<MotionVector> V_WB;  ///< velocity of each body at Bo, in W

  // For the recursive algorithms. The joint's motion in W is V_WB = shift(V_WC) + sum_k S_k v_k,
  // each column S_k turning or displacing along one direction (Mechanism::angular says which).
  std::vector<Vector3> direction_W;  ///< for each v: direction of its column S_k at Bo
  std::vector<Vector3> p_CB_W;       ///< for each body: from the carrier's origin to Bo
  std::vector<MotionVector>
      A_bias_W;  ///< for each body: c = dS/dt v + centripetal part (paper eq. 6)
};

/// Poses and velocities of all bodies from the joint coordinates (paper eq. 1, outwards from the
/// base). Sizes: q nq, v nv. Quaternions need not have unit length. Does not allocate.
void compute_kinematics(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                        Kinematics& kinematics);

/// Accelerations A_WB of all bodies at Bo in W from vdot (paper eq. 2). `A_WB`: one a body; not
/// resized.
void compute_accelerations(const Mechanism& mechanism, const Kinematics& kinematics,
                           ConstVectorRef vdot, std::vector<MotionVector>& A_WB);

/// Position in W of the point Q fixed in the body at p_BoQ_B, m.
inline Vector3 point_position(const Kinematics& kinematics, BodyIndex body,
                              const Vector3& p_BoQ_B) {
  return kinematics.X_WB[body].apply(p_BoQ_B);
}

/// Velocity in W of the point Q fixed in the body, m/s.
inline Vector3 point_velocity(const Kinematics& kinematics, BodyIndex body,
                              const Vector3& p_BoQ_B) {
  const auto i = static_cast<std::size_t>(body);
  return shift(kinematics.V_WB[i], kinematics.X_WB[i].R * p_BoQ_B).linear;
}

/// Acceleration in W of the point Q fixed in the body: a_Q = a_Bo + alpha x r + w x (w x r), m/s2.
inline Vector3 point_acceleration(const Kinematics& kinematics,
                                  const std::vector<MotionVector>& A_WB, BodyIndex body,
                                  const Vector3& p_BoQ_B) {
  const auto i = static_cast<std::size_t>(body);
  const Vector3 r = kinematics.X_WB[i].R * p_BoQ_B;
  const Vector3& w = kinematics.V_WB[i].angular;
  return A_WB[i].linear + A_WB[i].angular.cross(r) + w.cross(w.cross(r));
}

/// Adds the force f_W (N) at the point Q fixed in the body to F_Bo_W, that body's force about Bo.
inline void add_point_force(const Kinematics& kinematics, BodyIndex body, const Vector3& p_BoQ_B,
                            const Vector3& f_W, std::vector<ForceVector>& F_Bo_W) {
  const auto i = static_cast<std::size_t>(body);
  F_Bo_W[i] += shift_to(ForceVector{Vector3::Zero(), f_W}, kinematics.X_WB[i].R * p_BoQ_B);
}

/// Jacobian (3 x nv, column-major) of the velocity of the point Q: v_Q = J v. Zero columns
/// included.
void point_jacobian(const Mechanism& mechanism, const Kinematics& kinematics, BodyIndex body,
                    const Vector3& p_BoQ_B, Eigen::Ref<Eigen::Matrix3Xd> jacobian);

/// Jacobian (6 x nv) of the body's spatial velocity at Bo in W, (angular; linear).
void body_jacobian(const Mechanism& mechanism, const Kinematics& kinematics, BodyIndex body,
                   Eigen::Ref<Eigen::Matrix<double, 6, Eigen::Dynamic>> jacobian);

}  // namespace blocklift::dynamics
