#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// What the loops of a mechanism demand at one state: workspace and result of compute_loops.
///
/// Rows of all loops follow one another in the order of Mechanism::loops(); there are
/// Mechanism::loop_row_count() of them. A row is a length (m) or an angle (rad), see
/// Mechanism::loop_row_is_angle. With G the Jacobian (rows x nv) and g the residual:
///   g(q) = 0,   G v = 0,   G vdot = gamma = -(dG/dt) v,   M vdot + h = tau + G^T lambda.
///
/// Row i of a joint loop is the power of a unit force (moment; force) that acts on the loop's
/// follower and, reversed, on its base, both at the follower's frame K: translations along the axes
/// of the base's frame, moments about them. Residuals of rotations are rotation vectors (of the
/// turn that carries one axis to the other, or one frame to the other): they are right in sign and
/// size up to half a turn, so that a rough start finds home. Their rate is the relative angular
/// velocity on the constraint itself; off it the two differ by the order of the residual.
struct LoopState {
  explicit LoopState(const Mechanism& mechanism);

  Eigen::VectorXd residual;  ///< g, m or rad
  Eigen::VectorXd velocity;  ///< G v, m/s or rad/s
  /// For each row the unit force on the follower about p_WK, in W; zero for gears and ropes.
  std::vector<ForceVector> unit_force_W;
  std::vector<Vector3> p_WK;  ///< for each loop: the follower's frame origin
  /// For the points of all ropes' paths, one after another: d(length)/d(p_WQ).
  std::vector<Vector3> path_direction_W;
};

/// Residual, velocity and unit forces of all loops at a state whose kinematics are given (sizes: q
/// nq, v nv). A length or offset still to be taken from the start has the residual zero. Does not
/// allocate.
/// @throws SimulationError if the points of a rod or of neighbours on a rope fall together, naming
/// the loop.
void compute_loops(const Mechanism& mechanism, const Kinematics& kinematics, ConstVectorRef q,
                   ConstVectorRef v, LoopState& state);

/// Jacobian G of the loops (rows x nv). `slot`: for each row of the loops the row of `jacobian` it
/// goes to,
/// -1: left out. Does not allocate.
void calc_loop_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                        const LoopState& state, const std::vector<int>& slot,
                        Eigen::Ref<Eigen::MatrixXd> jacobian);
/// The same with all rows (allocates: for set-up and tests).
Eigen::MatrixXd calc_loop_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                                   const LoopState& state);

/// G vdot + (dG/dt) v of all rows, from the accelerations A_WB of all bodies that belong to vdot
/// (see compute_accelerations). At vdot = 0 this is -gamma. Does not allocate.
void calc_loop_accelerations(const Mechanism& mechanism, const Kinematics& kinematics,
                             const LoopState& state, ConstVectorRef vdot,
                             const std::vector<MotionVector>& A_WB, VectorRef accelerations);

/// Adds the loops' forces at multipliers lambda (N or N m, one a row): on bodies to F_Bo_W, of
/// gears to tau (nv). Does not allocate.
void add_loop_forces(const Mechanism& mechanism, const Kinematics& kinematics,
                     const LoopState& state, ConstVectorRef lambda,
                     std::vector<ForceVector>& F_Bo_W, VectorRef tau);

/// Force of a loop on its second body about the origin of that body's loop frame, in W.
/// Rope_length: on the last point of its last path (its tension is -lambda: a length that is held
/// pulls where lambda < 0). Gear: zero; its multiplier is the joint force on the first joint.
ForceVector loop_force(const Mechanism& mechanism, const Kinematics& kinematics,
                       const LoopState& state, int loop, ConstVectorRef lambda);

}  // namespace blocklift::dynamics
