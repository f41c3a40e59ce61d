#pragma once

#include "algebra/factors.h"
#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// The equations of motion of a lift, linear about an instant: workspace and result of
/// calc_tangent_matrices. Over the free velocities (nv_free x nv_free each),
///   M dvdot + C dv + K e = 0,
/// e being the tangent increment of the coordinates (Mechanism::integrate), dv and dvdot the
/// changes of velocities and accelerations; time, drives and winches are held. M is the mass
/// matrix, C and K hold gyroscopic, centrifugal and geometric terms, damping, and the stiffness of
/// all ropes, pads and force elements that act. N/m, N m/rad and so on, as the velocities are. Of
/// loops, K holds what their forces do at held multipliers lambda; those change besides:  M dvdot +
/// C dv + K e = G^T dlambda.
struct TangentMatrices {
  explicit TangentMatrices(const LiftSystem& system);

  Eigen::MatrixXd mass, damping, stiffness;

  InverseDynamicsDerivatives inverse;          ///< of the whole mechanism, nv x nv
  ForceDerivatives forces;                     ///< of the whole mechanism, nv x nv
  Loads loads;                                 ///< with the forces of the loops
  std::optional<AddedInertiaWorkspace> added;  ///< where water moves with floating bodies
  DraughtShares water_shares;                  ///< of the draughts of a body that is lowered
  /// Of RadiatedWater's frames in their level axes, 6N x nv_free: u = J v, which memory knows.
  Eigen::MatrixXd frame_jacobian;
};

/// Tangent matrices at the instant that calc_right_hand_side has just left in the workspace; its v,
/// vdot and the loads of contacts are used (each acts as it did there, without its kink). At
/// rest after an equilibrium, with v and vdot zero, they are those of small vibrations. How added
/// mass and memory change with the draught of a body that is lowered is left out: of second order
/// in motion. Does not allocate.
void calc_tangent_matrices(const LiftSystem& system, double t, LiftWorkspace& w,
                           TangentMatrices& tangent);

/// The part of `tangent.stiffness` that is the stretching of ropes, springs and pads, at rest; the
/// rest is gravity and forces that turn. nv_free x nv_free. Overwrites tangent.forces.
void calc_elastic_stiffness(const LiftSystem& system, double t, LiftWorkspace& w,
                            TangentMatrices& tangent, Eigen::Ref<Eigen::MatrixXd> stiffness);

/// Workspace of calc_jacobian.
struct JacobianWorkspace {
  explicit JacobianWorkspace(const LiftSystem& system);

  TangentMatrices tangent;
  algebra::CholeskyFactors mass;  ///< of the free velocities, factorised
  Eigen::MatrixXd increments;     ///< nv x nq
  Eigen::MatrixXd rates_by_q;     ///< nq x nq
  Eigen::MatrixXd rates_by_v;     ///< nq x nv
  Eigen::MatrixXd scaled;         ///< nv_free x state_size
};

/// Jacobian d(dy/dt)/dy of the whole right-hand side (state_size x state_size) at the state y and
/// time t, the quaternions' kinematics dq/dt = N(q) v included:
///   [ dN(q)v/dq       N       ]
///   [ -M^-1 K E   -M^-1 C     ],   E the tangent increments of the coordinates;
/// with the memory of radiated water -M^-1 J^T C_x and its own rows (0, B J, A) besides.
/// Evaluates the right-hand side once and leaves it in w.vdot, w.rates. Does not allocate but for
/// radiated water.
/// @throws what calc_right_hand_side throws.
void calc_jacobian(const LiftSystem& system, double t, ConstVectorRef y, const Contacts* contacts,
                   LiftWorkspace& w, JacobianWorkspace& workspace,
                   Eigen::Ref<Eigen::MatrixXd> jacobian);

/// The same by central differences with the given relative step, for comparison (allocates).
Eigen::MatrixXd difference_jacobian(const LiftSystem& system, double t, ConstVectorRef y,
                                    const Contacts* contacts, LiftWorkspace& w, double step);

}  // namespace blocklift::dynamics
