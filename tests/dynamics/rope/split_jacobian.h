#pragma once

#include <gtest/gtest.h>

#include "dynamics/rope/rope_split.h"
#include "dynamics/simulation/jacobian.h"

namespace blocklift::dynamics::test {

/// Holds Newton's matrix of a lift against differences of its forces, with the first rope's second
/// bend sticking and sliding: exact but for what is small by the strain, and by the damping.
inline void expect_jacobian_of_split(const LiftSystem& lift, const Eigen::VectorXd& q,
                                     const Eigen::VectorXd& v) {
  LiftWorkspace w(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, q, v, y);
  const Contacts contacts{1};
  calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
  lift.ropes()[0].calc_path(w.kinematics, w.path);
  w.splits[0].begin(lift.ropes()[0], w.kinematics, w.path, w.rope_loads[0]);
  JacobianWorkspace workspace(lift);
  Eigen::MatrixXd jacobian(lift.state_size(), lift.state_size());
  for (const BendMotion motion : {BendMotion::sticks, BendMotion::to_last}) {
    calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
    w.splits[0].set_motion(1, motion);
    calc_jacobian(lift, 0.0, y, &contacts, w, workspace, jacobian);
    const Eigen::MatrixXd expected = difference_jacobian(lift, 0.0, y, &contacts, w, 1e-6);
    EXPECT_LT((jacobian - expected).norm(), 0.02 * expected.norm());
  }
}

}  // namespace blocklift::dynamics::test
