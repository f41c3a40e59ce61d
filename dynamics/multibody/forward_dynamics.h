#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// Workspace and by-products of compute_forward_dynamics.
struct ForwardDynamicsWorkspace {
  explicit ForwardDynamicsWorkspace(const Mechanism& mechanism);

  std::vector<MotionVector> A_WB;  ///< acceleration of each body at Bo, in W

  /// An articulated body about Bo, in W: the force it takes to accelerate it is inertia A + bias.
  struct ArticulatedBody {
    SpatialInertia inertia;
    ForceVector bias;
  };
  /// What elimination of one velocity leaves for the way outwards.
  struct Column {
    Vector3 U_moment = Vector3::Constant(not_a_number);  ///< U = inertia S
    Vector3 U_force = Vector3::Constant(not_a_number);
    double inverse_D = not_a_number;  ///< free: 1 / (S^T U)
    double u = not_a_number;          ///< free: tau - S^T bias; driven: S^T bias
  };
  std::vector<ArticulatedBody> articulated;  ///< one a body
  std::vector<Column> columns;               ///< one a velocity
  /// For each body: is its motion prescribed, all velocities being driven between it and the world?
  std::vector<char> prescribed;
};

/// Are the forces of drives asked for? Where not, bodies whose motion is prescribed are accelerated
/// alone: what they weigh and bear changes nothing for those that are free.
enum class DriveForces { wanted, unwanted };

/// Accelerations of the free velocities and forces of the driven ones: articulated-body algorithm
/// (paper eq. 15-18), hybrid as in Featherstone (2008), section 9.2.
///
/// F_Bo_W: external force on each body about Bo, in W, without gravity; body_count entries (entry
/// 0, on the world, has no effect). tau, vdot: nv entries, each half given and half found:
///
/// |      | free velocities                        | driven velocities            |
/// |------|----------------------------------------|------------------------------|
/// | tau  | given: joint force besides the damping | found: force of the drive    |
/// | vdot | found                                  | given: the prescribed motion |
///
/// The drive overcomes the joint's viscous damping too. Where drive forces are unwanted the driven
/// entries of tau mean nothing, and vdot is the same bit for bit. Does not allocate; cost linear in
/// the bodies.
///
/// The recursion runs in world axes about each body's own origin: carrying an inertia inwards is
/// then a mere shift, the rotations of the paper's X drop out, and poses and velocities are used as
/// they are. Joints of several degrees of freedom are eliminated one velocity at a time, which is
/// Gaussian elimination of the S^T I S of eq. 16.
///
/// @throws SimulationError if nothing resists some free velocity (its S^T I S is singular), naming
/// the body, or if the state or a force is not finite, naming the body nearest to the world where
/// it shows.
void compute_forward_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                              ConstVectorRef v, const std::vector<ForceVector>& F_Bo_W,
                              ForwardDynamicsWorkspace& workspace, VectorRef tau, VectorRef vdot,
                              DriveForces drives = DriveForces::wanted);

}  // namespace blocklift::dynamics
