#include "dynamics/force/loop_derivatives.h"

namespace blocklift::dynamics {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// A rod or a segment of a rope between two points, under a tension that is held.
void add_segment(const Kinematics& kinematics, BodyIndex from, const Vector3& p_From, BodyIndex to,
                 const Vector3& p_To, double tension, ForceDerivatives& derivatives) {
  const Vector3 span =
      point_position(kinematics, to, p_To) - point_position(kinematics, from, p_From);
  const Vector3 velocity =
      point_velocity(kinematics, to, p_To) - point_velocity(kinematics, from, p_From);
  const double length = span.norm();
  derivatives.locate(0, from, kinematics.X_WB[index(from)].R * p_From);
  derivatives.locate(1, to, kinematics.X_WB[index(to)].R * p_To);
  derivatives.add_tension(0, 1, {span / length, length, velocity}, tension, 0.0, 0.0);
}

// The last row of a universal joint's loop: a moment along x cross z, x fixed in the follower and z
// in the base.
void add_perpendicular(const Loop& loop, const Kinematics& kinematics, double lambda,
                       ForceDerivatives& derivatives) {
  const Vector3 z = kinematics.X_WB[index(loop.base)].R * loop.X_BaseK.R.col(2);
  const Vector3 x = kinematics.X_WB[index(loop.follower)].R * loop.X_FollowerK.R.col(0);
  const Vector3 normal = x.cross(z);
  const double sine = normal.norm();
  if (!(sine > 1e-9)) return;
  const Vector3 d = normal / sine;
  const Matrix3 across = lambda / sine * (Matrix3::Identity() - d * d.transpose());
  Matrix6 by_follower = Matrix6::Zero();
  Matrix6 by_base = Matrix6::Zero();
  by_follower.topLeftCorner<3, 3>() = across * skew(z) * skew(x);
  by_base.topLeftCorner<3, 3>() = -across * skew(x) * skew(z);
  const Matrix6 none = Matrix6::Zero();
  derivatives.add_wrench_block(0, 0, by_follower, none);
  derivatives.add_wrench_block(0, 1, by_base, none);
  derivatives.add_wrench_block(1, 0, -by_follower, none);
  derivatives.add_wrench_block(1, 1, -by_base, none);
}

// Two frames: the force on the follower at its frame has the axes of the base; that on the base is
// its opposite at the same place, which moves with the follower.
void add_pair(const Loop& loop, const Kinematics& kinematics, const Vector3& p_WK,
              const LoopState& state, ConstVectorRef lambda, ForceDerivatives& derivatives) {
  derivatives.locate(0, loop.follower, p_WK - kinematics.X_WB[index(loop.follower)].p);
  derivatives.locate(1, loop.base, p_WK - kinematics.X_WB[index(loop.base)].p);
  const bool perpendicular = loop.rotation == Loop::Rotation::axes_perpendicular;
  const int last = loop.row_offset + loop.row_count - (perpendicular ? 1 : 0);
  ForceVector F = ForceVector::zero();
  for (int row = loop.row_offset; row < last; ++row) {
    F += lambda[row] * state.unit_force_W[index(row)];
  }
  derivatives.add_held_force(0, F.force);
  derivatives.add_held_force(1, -F.force);
  const Matrix6 none = Matrix6::Zero();
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = -skew(F.moment);
  turn.bottomLeftCorner<3, 3>() = -skew(F.force);
  Matrix6 wander = Matrix6::Zero();
  wander.topRightCorner<3, 3>() = skew(F.force);
  derivatives.add_wrench_block(0, 1, turn, none);
  derivatives.add_wrench_block(1, 1, -turn - wander, none);
  derivatives.add_wrench_block(1, 0, wander, none);
  if (perpendicular) add_perpendicular(loop, kinematics, lambda[last], derivatives);
}

}  // namespace

void add_loop_derivatives(const Mechanism& mechanism, const Kinematics& kinematics,
                          const LoopState& state, ConstVectorRef lambda,
                          ForceDerivatives& derivatives) {
  for (std::size_t i = 0; i < mechanism.loops().size(); ++i) {
    const Loop& loop = mechanism.loops()[i];
    if (loop.kind == LoopKind::distance) {
      add_segment(kinematics, loop.base, loop.X_BaseK.p, loop.follower, loop.X_FollowerK.p,
                  -lambda[loop.row_offset], derivatives);
    } else if (loop.follower >= 0) {
      add_pair(loop, kinematics, state.p_WK[i], state, lambda, derivatives);
    }
    for (const auto& path : loop.paths) {
      for (std::size_t k = 1; k < path.size(); ++k) {
        add_segment(kinematics, path[k - 1].body, path[k - 1].p_BoQ_B, path[k].body,
                    path[k].p_BoQ_B, -lambda[loop.row_offset], derivatives);
      }
    }
  }
}

}  // namespace blocklift::dynamics
