#pragma once

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// The loops' demand on the accelerations, linear about an instant: workspace and result of
/// LoopTangent::calc. With a(q, v, vdot) = G vdot + (dG/dt) v,
///   G dvdot + by_v dv + by_q e = 0
/// over the free velocities, e being the tangent increment of the coordinates; a row for each
/// equation of the loops that is enforced and independent there.
class LoopTangent {
 public:
  explicit LoopTangent(const LiftSystem& system);

  /// At the instant that calc_right_hand_side has just left in `w`, which has loops. G is exact;
  /// by_q and by_v are forward differences of the loops' accelerations alone (kinematics and loops:
  /// no dynamics, no forces), accurate to about 1e-7 of their size. Does not allocate.
  void calc(const LiftSystem& system, const LiftWorkspace& w);

  Eigen::Index row_count() const { return count_; }
  auto jacobian() const { return jacobian_.topRows(count_); }  ///< G, rows x nv_free
  auto by_q() const { return by_q_.topRows(count_); }          ///< rows x nv_free
  auto by_v() const { return by_v_.topRows(count_); }          ///< rows x nv_free

 private:
  void choose_rows(const LiftWorkspace& w);
  void accelerations(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                     ConstVectorRef vdot);

  Eigen::Index count_ = 0;
  std::vector<int> slot_;  ///< for each row of the loops its place here, -1: left out
  Kinematics kinematics_;
  LoopState state_;
  std::vector<MotionVector> A_WB_;
  Eigen::VectorXd q_, v_, a_, a_here_;
  Eigen::MatrixXd whole_, jacobian_, by_q_, by_v_;
};

}  // namespace blocklift::dynamics
