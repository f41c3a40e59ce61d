#pragma once

#include <vector>

#include "algebra/factors.h"
#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// Columns of all joints and their rates, in W axes about one common origin O at rest: spatial
/// vectors of different bodies then add and cross without shifts. O is the mean of the bodies'
/// origins, so that no digits are lost far from the world's origin.
///
/// A joint of several velocities whose v are dq/dt is a chain of single ones in the order of v: the
/// column of one is moved by those before it. The columns of spherical and free joints are fixed in
/// the body B. `before` is the frame that carries column k: the chain up to k, or the carrier.
struct MotionColumns {
  explicit MotionColumns(const Mechanism& mechanism);

  Vector3 p_WO = Vector3::Constant(not_a_number);  ///< the common origin, m
  std::vector<MotionVector> S;                     ///< for each v: column S_k about O, in W
  std::vector<MotionVector> S_swing;               ///< for each v: V_before x S_k
  std::vector<MotionVector> S_rate;                ///< for each v: dS_k/dt
  std::vector<MotionVector> V;  ///< for each link's body: its spatial velocity at O, in W
};

/// Columns and rates of the state that `kinematics` holds. `v`: nv. Does not allocate.
void compute_motion_columns(const Mechanism& mechanism, const Kinematics& kinematics,
                            ConstVectorRef v, MotionColumns& columns);

/// Workspace and result of compute_inverse_dynamics_derivatives.
struct InverseDynamicsDerivatives {
  explicit InverseDynamicsDerivatives(const Mechanism& mechanism);

  Eigen::MatrixXd dtau_dq;  ///< nv x nv, by tangent increments of q (see below)
  Eigen::MatrixXd dtau_dv;  ///< nv x nv
  Eigen::MatrixXd mass;     ///< nv x nv: dtau/dvdot, which the same pass yields

  MotionColumns columns;
  /// A body with all that it carries, about O, in W.
  struct Composite {
    SpatialInertia inertia;
    Matrix3 coriolis;      ///< angular half of B, see below
    Vector3 momentum;      ///< linear
    ForceVector inertial;  ///< force that its motion asks for, gravity taken off
    ForceVector external;  ///< of the external forces
    Matrix3 arms;          ///< the external forces' moment about O by a turn about O
  };
  std::vector<Composite> composites;       ///< one a body
  std::vector<MotionVector> A;             ///< one a body: spatial acceleration at O less gravity
  std::vector<MotionVector> S_swing_rate;  ///< one a velocity: A_before x S + V_before x S_swing
};

/// Derivatives of the inverse dynamics tau(q, v, vdot) of compute_inverse_dynamics, and M.
///
/// By q: for the tangent increment d that moves q to q (+) d (Mechanism::integrate with s = 1),
/// which is dq where v is dq/dt; v, vdot are held as numbers. The external forces F_Bo_W are held,
/// each with its moment about its Bo, except for `arm_moments`: a 3x3 matrix a body whose product
/// with the body's turn (in W) is the change of F_Bo_W's moment; sum [f]x [r]x for held forces f at
/// points at r from Bo fixed in the body (empty: zero). Zero at pairs of joints that do not carry
/// one another.
///
/// With P = V_before x S, Q = A_before x S + V_before x P, and composites of the outer of both
/// joints:
///   dtau_l/dq_k = S_l (I Q_k + B P_k) + [S_k x* - d/dq_k] F_ext        (l carried by k),
///   dtau_l/dq_k = S_l (I Q_k + B P_k + S_k x* F - dF_ext/dq_k)         (k carried by l),
///   dtau_l/dv_k = S_l (I (P_k + dS_k/dt) + B S_k) + damping,           M_lk = S_l I S_k,
///   B x = V x* I x - I (V x x) + x x* I V, which for a rigid body is
///   (([w]x (2 J - tr J 1) - 2 [h]x [v_O]x) x_angular; -2 p x x_angular), p the linear momentum.
/// Cost O(nv x depth). Does not allocate.
/// Source: Carpentier and Mansard (2018), RSS; Singh, Russell and Wensing (2022), IEEE RA-L 7(2),
/// whose spatial-vector form is used about O and extended by external forces, chains and body-fixed
/// columns.
void compute_inverse_dynamics_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                                          ConstVectorRef v, ConstVectorRef vdot,
                                          const std::vector<ForceVector>& F_Bo_W,
                                          const std::vector<Matrix3>& arm_moments,
                                          InverseDynamicsDerivatives& derivatives);

/// Workspace and result of compute_forward_dynamics_derivatives.
struct ForwardDynamicsDerivatives {
  explicit ForwardDynamicsDerivatives(const Mechanism& mechanism);

  InverseDynamicsDerivatives inverse;
  /// nv x nv. Row k is the derivative of what forward dynamics finds for velocity k: of vdot_k
  /// where it is free, of the drive's force tau_k where it is driven.
  Eigen::MatrixXd by_q, by_v;

 private:
  friend void compute_forward_dynamics_derivatives(const Mechanism& mechanism,
                                                   const Kinematics& kinematics, ConstVectorRef v,
                                                   ConstVectorRef vdot,
                                                   const std::vector<ForceVector>& F_Bo_W,
                                                   ForwardDynamicsDerivatives& derivatives);
  Eigen::MatrixXd free_mass_, right_;
  algebra::CholeskyFactors factor_;
};

/// Derivatives of compute_forward_dynamics at the accelerations vdot that it has found, with F_Bo_W
/// and the given tau held and the driven velocities' motion prescribed:
///   dvdot_free = -M_free^-1 dID_free,   dtau_driven = dID_driven + M_driven,free dvdot_free.
/// By q as for compute_inverse_dynamics_derivatives. Cost O(nv x depth) and a Cholesky
/// factorisation.
/// @throws SimulationError if the mass matrix of the free velocities is singular.
void compute_forward_dynamics_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                                          ConstVectorRef v, ConstVectorRef vdot,
                                          const std::vector<ForceVector>& F_Bo_W,
                                          ForwardDynamicsDerivatives& derivatives);

/// The tangent increment e (nv) that a change dq of the coordinates (nq, quaternions of any length)
/// amounts to:  q + dq = q (+) e  to first order, the length of quaternions left aside.
/// Of one joint (its own entries of q; nv x nq of the joint) and of the mechanism (nv x nq).
void joint_increments(JointKind kind, const double* q, Eigen::Ref<Eigen::MatrixXd> increments);
void coordinate_increments(const Mechanism& mechanism, ConstVectorRef q,
                           Eigen::Ref<Eigen::MatrixXd> increments);

/// Derivatives of the rates dq/dt of Mechanism::calc_rates: by_q (nq x nq, by the coordinates
/// themselves, zero but at quaternions and at the displacement of free joints) and by_v (nq x nv).
void joint_rate_derivatives(JointKind kind, const double* q, const double* v,
                            Eigen::Ref<Eigen::MatrixXd> by_q, Eigen::Ref<Eigen::MatrixXd> by_v);
void rate_derivatives(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                      Eigen::Ref<Eigen::MatrixXd> by_q, Eigen::Ref<Eigen::MatrixXd> by_v);

/// How a further increment of u (nv) moves the pose q (+) u:
///   q (+) (u + du) = (q (+) u) (+) D du  to first order.  nv x nv, D = 1 at u = 0: the right
///     Jacobian of
/// the exponential, sum (-ad_u)^n / (n+1)! (Chirikjian 2012, section 10.2), for joints with a
/// quaternion.
void increment_jacobian(const Mechanism& mechanism, ConstVectorRef u,
                        Eigen::Ref<Eigen::MatrixXd> jacobian);

}  // namespace blocklift::dynamics
