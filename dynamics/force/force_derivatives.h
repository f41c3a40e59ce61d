#pragma once

#include <vector>

#include "dynamics/multibody/derivatives.h"

namespace blocklift::dynamics {

/// Collects how the loads on a mechanism change with its motion: workspace and result.
///
/// Force elements say it by blocks: the change of a force at a body point by the displacement and
/// the velocity of body points. With J the Jacobian of a point and d/dq the derivative by tangent
/// increments at held v (numbers), a block K = df/dp, C = df/dv at point a, caused by point b, adds
///   dtau/dq += J_a^T (K J_b + C dv_b/dq),    dtau/dv += J_a^T C J_b,
/// to the derivatives of the generalised forces. What remains, the turning of J_a itself under a
/// force that is held, belongs to the mechanism: compute_inverse_dynamics_derivatives takes it from
/// the forces and from `arm_moments`. All points of one element are located first, in slots from 0
/// on.
class ForceDerivatives {
 public:
  /// @param most_points the most points that one element has.
  ForceDerivatives(const Mechanism& mechanism, std::size_t most_points);

  /// Begins anew at the instant of `kinematics`, with its columns; both must stay until the end.
  /// @param stretch_only leaves out what forces that are held do by turning with their line or
  /// body, and wrench blocks that do not stretch: what remains at rest is the stiffness of
  /// stretching alone.
  void start(const Kinematics& kinematics, const MotionColumns& columns, bool stretch_only = false);

  /// Slot: the point fixed in the body at r_W from Bo (in W, m).
  void locate(std::size_t slot, BodyIndex body, const Vector3& r_W);
  /// The force f_W (N) acts at the point: its moment about Bo turns with the body.
  void add_held_force(std::size_t slot, const Vector3& f_W);
  /// The force at `on` changes by  df_dp dp_by + df_dv dv_by  (N/m, N s/m).
  void add_block(std::size_t on, std::size_t by, const Matrix3& df_dp, const Matrix3& df_dv);
  /// The force at `from` changes by  df_dx (dp_to - dp_from) + df_dv (dv_to - dv_from), that at
  /// `to` by the opposite: what a line between two points does.
  void add_line(std::size_t from, std::size_t to, const Matrix3& df_dx, const Matrix3& df_dv);
  /// A straight line that draws its points together with a tension T(L, dL/dt) (N): with u its
  /// direction,
  ///   K = dT/dL u u^T + T/L (1 - u u^T) + dT/dLdot u e^T,  e = (1 - u u^T) (v_to - v_from)/L,
  ///   C = dT/dLdot u u^T,
  /// the tension's turning with the line (geometric stiffness) included, and both ends held.
  struct Line {
    Vector3 direction_W;          ///< u, unit, from `from` to `to`
    double length;                ///< L, m
    Vector3 relative_velocity_W;  ///< v_to - v_from, m/s
  };
  void add_tension(std::size_t from, std::size_t to, const Line& line, double tension, double dT_dL,
                   double dT_dLdot);
  /// The force at the point changes by df_dtheta times the turn of its body (in W): N/rad.
  void add_turning(std::size_t slot, const Matrix3& df_dtheta);
  /// The force (moment; force) about the slot's point changes by the motion (angular; linear) of
  /// the body at that point and by its velocity there, in W. `stretches`: what the motion changes
  /// is the stretching of a spring.
  void add_wrench_block(std::size_t on, std::size_t by, const Eigen::Matrix<double, 6, 6>& dF_dX,
                        const Eigen::Matrix<double, 6, 6>& dF_dV, bool stretches = false);
  /// The joint force at velocity k of the mechanism changes with its own coordinate and velocity.
  void add_joint(int k, double dtau_dq, double dtau_dv) {
    dtau_dq_(k, k) += dtau_dq;
    dtau_dv_(k, k) += dtau_dv;
  }

  /// Adds derivatives of the generalised forces that an element has put together itself (nv x nv).
  void add_generalised(const Eigen::MatrixXd& dtau_dq, const Eigen::MatrixXd& dtau_dv) {
    dtau_dq_ += dtau_dq;
    dtau_dv_ += dtau_dv;
  }
  /// Adds a located point's motion by each velocity: dp/dq (which is dv/dv) and dv/dq, 3 x nv each.
  /// @param rate_W velocity of the point within its body, which turns with it.
  void add_motion(std::size_t slot, const Vector3& rate_W, Eigen::Ref<Eigen::MatrixXd> p,
                  Eigen::Ref<Eigen::MatrixXd> v_q) const;
  /// Adds the turn of the point's body by each velocity, 3 x nv.
  void add_turn(std::size_t slot, Eigen::Ref<Eigen::MatrixXd> turn) const;
  /// As `start` was told.
  bool stretch_only() const { return stretch_only_; }

  const Eigen::MatrixXd& dtau_dq() const { return dtau_dq_; }  ///< nv x nv, by tangent increments
  const Eigen::MatrixXd& dtau_dv() const { return dtau_dv_; }  ///< nv x nv
  /// One a body, see compute_inverse_dynamics_derivatives.
  const std::vector<Matrix3>& arm_moments() const { return arm_moments_; }

 private:
  // A point's motion by the velocities that move it, a column each.
  struct Point {
    BodyIndex body = world_index;
    Vector3 r_W = Vector3::Zero();
    int count = 0;
    std::vector<int> velocity;           // index within v
    Eigen::Matrix3Xd turn, p, w_q, v_q;  // d(theta, p, w, v)/dq; dw/dv = turn, dv/dv = p
  };

  const Mechanism* mechanism_;
  const Kinematics* kinematics_ = nullptr;
  const MotionColumns* columns_ = nullptr;
  bool stretch_only_ = false;
  std::vector<Point> points_;
  std::vector<Matrix3> arm_moments_;
  Eigen::MatrixXd dtau_dq_, dtau_dv_;
};

}  // namespace blocklift::dynamics
