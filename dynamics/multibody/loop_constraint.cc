#include "dynamics/multibody/loop_constraint.h"

#include <cmath>
#include <numeric>

#include "dynamics/errors.h"
#include "dynamics/index.h"

namespace blocklift::dynamics {
namespace {

// Two points nearer than this have no direction, m.
constexpr double no_direction = 1e-9;

[[noreturn]] void report_coincidence(const Loop& loop) {
  throw SimulationError("loop \"" + loop.name + "\": two points of its " +
                        (loop.kind == LoopKind::distance ? "rod" : "rope") +
                        " fall together, so that its direction is undefined");
}

// angle / sin(angle) of a turn whose sine and cosine (times a common factor) are known; sine >= 0.
double angle_over_sine(double sine, double cosine) {
  return sine > 1e-9 ? std::atan2(sine, cosine) / sine : 1.0;
}

/// A pair of frames at an instant: base K (axes) and follower K.
struct FramePair {
  FramePair(const Loop& loop, const Kinematics& kinematics)
      : X_WB(kinematics.X_WB[loop.base]),
        X_WF(kinematics.X_WB[loop.follower]),
        V_WB(kinematics.V_WB[loop.base]),
        V_WF(kinematics.V_WB[loop.follower]),
        R_WK(X_WB.R * loop.X_BaseK.R),
        p_WK(X_WB.apply(loop.X_BaseK.p)),
        p_WFollowerK(X_WF.apply(loop.X_FollowerK.p)),
        base_arm(p_WFollowerK - X_WB.p),
        follower_arm(X_WF.R * loop.X_FollowerK.p),
        w_relative(V_WF.angular - V_WB.angular),
        u_relative(shift(V_WF, follower_arm).linear - shift(V_WB, base_arm).linear) {}

  Matrix3 follower_axes(const Loop& loop) const { return X_WF.R * loop.X_FollowerK.R; }

  const Pose& X_WB;          ///< base body
  const Pose& X_WF;          ///< follower body
  const MotionVector& V_WB;  ///< base body
  const MotionVector& V_WF;  ///< follower body
  Matrix3 R_WK;              ///< the base's frame
  Vector3 p_WK;              ///< origin of the base's frame
  Vector3 p_WFollowerK;      ///< origin of the follower's frame
  Vector3 base_arm;          ///< from the base body's origin to the follower's frame
  Vector3 follower_arm;      ///< from the follower body's origin to the follower's frame
  Vector3 w_relative;        ///< angular velocity of the follower in the base
  Vector3 u_relative;        ///< velocity of the follower's frame origin as seen from the base
};

/// Writes the rows of one loop between two frames.
class PairRows {
 public:
  PairRows(const Loop& loop, const FramePair& pair, LoopState& state)
      : loop_(loop), pair_(pair), state_(state), row_(loop.row_offset) {}

  void write() {
    if (loop_.kind == LoopKind::distance) {
      distance();
      return;
    }
    const Vector3 p = pair_.p_WFollowerK - pair_.p_WK;
    for (const int axis : loop_.held_translations) {
      const Vector3 direction = pair_.R_WK.col(axis);
      add(direction.dot(p), Vector3::Zero(), direction);
    }
    switch (loop_.rotation) {
      case Loop::Rotation::none:
        break;
      case Loop::Rotation::axes_parallel:
        axes_parallel();
        break;
      case Loop::Rotation::axes_perpendicular:
        axes_perpendicular();
        break;
      case Loop::Rotation::equal:
        equal();
        break;
    }
  }

 private:
  void add(double residual, const Vector3& moment, const Vector3& force) {
    state_.residual[row_] = residual;
    state_.velocity[row_] = moment.dot(pair_.w_relative) + force.dot(pair_.u_relative);
    state_.unit_force_W[row_] = {moment, force};
    ++row_;
  }

  void distance() {
    const Vector3 p = pair_.p_WFollowerK - pair_.p_WK;
    const double length = p.norm();
    if (!(length > no_direction)) report_coincidence(loop_);
    add(std::isnan(loop_.length) ? 0.0 : length - loop_.length, Vector3::Zero(), p / length);
  }

  // The turn that carries the base's z to the follower's.
  void axes_parallel() {
    const Vector3 z = pair_.X_WF.R * loop_.X_FollowerK.R.col(2);
    const Vector3 in_base = pair_.R_WK.transpose() * z;
    const double sine = std::hypot(in_base.x(), in_base.y());
    const double factor = angle_over_sine(sine, in_base.z());
    // Exactly opposite: half a turn about x, for want of a direction.
    const bool opposite = sine <= 1e-9 && in_base.z() < 0.0;
    add(opposite ? M_PI : -in_base.y() * factor, pair_.R_WK.col(0), Vector3::Zero());
    add(opposite ? 0.0 : in_base.x() * factor, pair_.R_WK.col(1), Vector3::Zero());
  }

  // The angle by which the base's z and the follower's x miss the right angle.
  void axes_perpendicular() {
    const Vector3 z = pair_.R_WK.col(2);
    const Vector3 x = pair_.X_WF.R * loop_.X_FollowerK.R.col(0);
    const Vector3 normal = x.cross(z);
    const double sine = normal.norm();
    const Vector3 direction = sine > 1e-9 ? Vector3(normal / sine) : Vector3(pair_.R_WK.col(1));
    add(std::atan2(z.dot(x), sine), direction, Vector3::Zero());
  }

  // The turn that carries the base's frame to the follower's.
  void equal() {
    const Matrix3 R = pair_.R_WK.transpose() * pair_.follower_axes(loop_);
    const Vector3 turn = rotation_vector(quaternion_from_rotation(R));
    for (int i = 0; i < 3; ++i) add(turn[i], pair_.R_WK.col(i), Vector3::Zero());
  }

  const Loop& loop_;
  const FramePair& pair_;
  LoopState& state_;
  int row_;
};

void write_gear(const Loop& loop, const double* q, const double* v, LoopState& state) {
  state.residual[loop.row_offset] =
      std::isnan(loop.offset)
          ? 0.0
          : q[loop.first_coordinate] - loop.ratio * q[loop.second_coordinate] - loop.offset;
  state.velocity[loop.row_offset] = v[loop.first_velocity] - loop.ratio * v[loop.second_velocity];
}

// Calls function(loop, first entry within path_direction_W) for each rope.
template <class Function>
void for_each_rope(const Mechanism& mechanism, Function&& function) {
  std::size_t first = 0;
  for (const Loop& loop : mechanism.loops()) {
    if (loop.kind != LoopKind::rope_length) continue;
    function(loop, first);
    for (const auto& path : loop.paths) first += path.size();
  }
}

void write_rope(const Loop& loop, const Kinematics& kinematics, std::size_t first,
                LoopState& state) {
  double length = 0.0, rate = 0.0;
  for (const auto& path : loop.paths) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      state.path_direction_W[first + i].setZero();
    }
    Vector3 p = point_position(kinematics, path[0].body, path[0].p_BoQ_B);
    Vector3 v = point_velocity(kinematics, path[0].body, path[0].p_BoQ_B);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vector3 p_next = point_position(kinematics, path[i].body, path[i].p_BoQ_B);
      const Vector3 v_next = point_velocity(kinematics, path[i].body, path[i].p_BoQ_B);
      const double segment = (p_next - p).norm();
      if (!(segment > no_direction)) report_coincidence(loop);
      const Vector3 direction = (p_next - p) / segment;
      state.path_direction_W[first + i - 1] -= direction;
      state.path_direction_W[first + i] += direction;
      length += segment;
      rate += direction.dot(v_next - v);
      p = p_next;
      v = v_next;
    }
    first += path.size();
  }
  state.residual[loop.row_offset] = std::isnan(loop.length) ? 0.0 : length - loop.length;
  state.velocity[loop.row_offset] = rate;
}

// Second time derivative of a rope's length.
double rope_acceleration(const Loop& loop, const Kinematics& kinematics,
                         const std::vector<MotionVector>& A_WB) {
  double sum = 0.0;
  for (const auto& path : loop.paths) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Loop::PathPoint& a = path[i - 1];
      const Loop::PathPoint& b = path[i];
      const Vector3 p = point_position(kinematics, b.body, b.p_BoQ_B) -
                        point_position(kinematics, a.body, a.p_BoQ_B);
      const Vector3 v = point_velocity(kinematics, b.body, b.p_BoQ_B) -
                        point_velocity(kinematics, a.body, a.p_BoQ_B);
      const Vector3 acceleration = point_acceleration(kinematics, A_WB, b.body, b.p_BoQ_B) -
                                   point_acceleration(kinematics, A_WB, a.body, a.p_BoQ_B);
      const double length = p.norm();
      const Vector3 direction = p / length;
      const double along = direction.dot(v);
      sum += direction.dot(acceleration) + (v.squaredNorm() - along * along) / length;
    }
  }
  return sum;
}

// Rate of the unit direction x cross z, x fixed in the follower and z in the base.
Vector3 perpendicular_rate(const Loop& loop, const FramePair& pair, const Vector3& direction) {
  const Vector3 z = pair.R_WK.col(2);
  const Vector3 x = pair.X_WF.R * loop.X_FollowerK.R.col(0);
  const double sine = x.cross(z).norm();
  if (!(sine > 1e-9)) return pair.V_WB.angular.cross(direction);
  const Vector3 rate =
      pair.V_WF.angular.cross(x).cross(z) + x.cross(Vector3(pair.V_WB.angular.cross(z)));
  return (rate - rate.dot(direction) * direction) / sine;
}

void pair_accelerations(const Loop& loop, const FramePair& pair, const LoopState& state,
                        const std::vector<MotionVector>& A_WB, VectorRef result) {
  const MotionVector& A_B = A_WB[loop.base];
  const MotionVector& A_F = A_WB[loop.follower];
  const Vector3& w_B = pair.V_WB.angular;
  const Vector3& w_F = pair.V_WF.angular;
  const Vector3 angular = A_F.angular - A_B.angular;
  // d/dt of u_relative = v_K - v_Bo - w_B x (p_K - p_Bo).
  const Vector3 v_K = shift(pair.V_WF, pair.follower_arm).linear;
  const Vector3 a_K =
      shift(A_F, pair.follower_arm).linear + w_F.cross(w_F.cross(pair.follower_arm));
  const Vector3 linear =
      a_K - A_B.linear - A_B.angular.cross(pair.base_arm) - w_B.cross(v_K - pair.V_WB.linear);
  for (int row = loop.row_offset; row < loop.row_offset + loop.row_count; ++row) {
    const ForceVector& unit = state.unit_force_W[row];
    const bool perpendicular = loop.rotation == Loop::Rotation::axes_perpendicular &&
                               row == loop.row_offset + loop.row_count - 1;
    const Vector3 moment_rate =
        perpendicular ? perpendicular_rate(loop, pair, unit.moment) : w_B.cross(unit.moment);
    result[row] = unit.moment.dot(angular) + unit.force.dot(linear) +
                  moment_rate.dot(pair.w_relative) + w_B.cross(unit.force).dot(pair.u_relative);
  }
}

// Second time derivative of the distance of two points.
double distance_acceleration(const Loop& loop, const FramePair& pair, const Kinematics& kinematics,
                             const Vector3& direction, const std::vector<MotionVector>& A_WB) {
  const Vector3 v = point_velocity(kinematics, loop.follower, loop.X_FollowerK.p) -
                    point_velocity(kinematics, loop.base, loop.X_BaseK.p);
  const Vector3 a = point_acceleration(kinematics, A_WB, loop.follower, loop.X_FollowerK.p) -
                    point_acceleration(kinematics, A_WB, loop.base, loop.X_BaseK.p);
  const double along = direction.dot(v);
  return direction.dot(a) +
         (v.squaredNorm() - along * along) / (pair.p_WFollowerK - pair.p_WK).norm();
}

bool is_pair(const Loop& loop) { return loop.follower >= 0; }

/// Fills rows of the Jacobian along the chains of bodies from a loop towards the world.
class JacobianRows {
 public:
  JacobianRows(const Mechanism& mechanism, const Kinematics& kinematics, const LoopState& state,
               const std::vector<int>& slot, Eigen::Ref<Eigen::MatrixXd> jacobian)
      : mechanism_(mechanism),
        kinematics_(kinematics),
        state_(state),
        slot_(slot),
        jacobian_(jacobian) {}

  void pair(const Loop& loop, std::size_t number) {
    chain(loop, loop.follower, 1.0, state_.p_WK[number]);
    chain(loop, loop.base, -1.0, state_.p_WK[number]);
  }

  void gear(const Loop& loop) {
    const int row = slot_[loop.row_offset];
    if (row < 0) return;
    jacobian_(row, loop.first_velocity) = 1.0;
    jacobian_(row, loop.second_velocity) = -loop.ratio;
  }

  void rope(const Loop& loop, std::size_t first) {
    const int row = slot_[loop.row_offset];
    if (row < 0) return;
    for (const auto& path : loop.paths) {
      for (const Loop::PathPoint& point : path) {
        const Vector3 p_WQ = point_position(kinematics_, point.body, point.p_BoQ_B);
        const Vector3& direction = state_.path_direction_W[first++];
        for_chain(point.body, world_index,
                  [&](int k, bool angular, const Vector3& S, const Vector3& p_WB) {
                    jacobian_(row, k) +=
                        angular ? S.dot((p_WQ - p_WB).cross(direction)) : S.dot(direction);
                  });
      }
    }
  }

 private:
  // Calls function(k, angular, direction, origin) for each velocity between the body and `end`.
  template <class Function>
  void for_chain(BodyIndex body, BodyIndex end, Function&& function) {
    const std::vector<Body>& bodies = mechanism_.bodies();
    if (body != world_index && bodies[body].nv() == 0) body = bodies[body].carrier;
    while (body != end && body != world_index) {
      const Body& b = bodies[body];
      for (int k = b.v_offset; k < b.v_offset + b.nv(); ++k) {
        function(k, mechanism_.angular()[k] != 0, kinematics_.direction_W[k],
                 kinematics_.X_WB[body].p);
      }
      body = b.carrier;
    }
  }

  void chain(const Loop& loop, BodyIndex body, double sign, const Vector3& p_WK) {
    for_chain(body, loop.common, [&](int k, bool angular, const Vector3& S, const Vector3& p_WB) {
      // Velocity of the loop's frame when this velocity is one: angular S, linear S x arm.
      const Vector3 linear = angular ? Vector3(S.cross(p_WK - p_WB)) : S;
      for (int i = loop.row_offset; i < loop.row_offset + loop.row_count; ++i) {
        const int row = slot_[i];
        if (row < 0) continue;
        const ForceVector& unit = state_.unit_force_W[i];
        double power = unit.force.dot(linear);
        if (angular) power += unit.moment.dot(S);
        jacobian_(row, k) += sign * power;
      }
    });
  }

  const Mechanism& mechanism_;
  const Kinematics& kinematics_;
  const LoopState& state_;
  const std::vector<int>& slot_;
  Eigen::Ref<Eigen::MatrixXd> jacobian_;
};

// Adds a force about the point p_WQ to a body's force about its origin.
void add_force(const Kinematics& kinematics, BodyIndex body, const Vector3& p_WQ,
               const ForceVector& F_Q_W, std::vector<ForceVector>& F_Bo_W) {
  F_Bo_W[body] += shift_to(F_Q_W, p_WQ - kinematics.X_WB[body].p);
}

ForceVector force_on_follower(const Loop& loop, const LoopState& state, ConstVectorRef lambda) {
  ForceVector F = ForceVector::zero();
  for (int row = loop.row_offset; row < loop.row_offset + loop.row_count; ++row) {
    F += lambda[row] * state.unit_force_W[row];
  }
  return F;
}

}  // namespace

LoopState::LoopState(const Mechanism& mechanism)
    : residual(Eigen::VectorXd::Zero(mechanism.loop_row_count())),
      velocity(Eigen::VectorXd::Zero(mechanism.loop_row_count())),
      unit_force_W(index(mechanism.loop_row_count()), ForceVector::zero()),
      p_WK(mechanism.loops().size(), Vector3::Zero()) {
  std::size_t points = 0;
  for (const Loop& loop : mechanism.loops()) {
    for (const auto& path : loop.paths) points += path.size();
  }
  path_direction_W.assign(points, Vector3::Zero());
}

void compute_loops(const Mechanism& mechanism, const Kinematics& kinematics, ConstVectorRef q,
                   ConstVectorRef v, LoopState& state) {
  for (std::size_t i = 0; i < mechanism.loops().size(); ++i) {
    const Loop& loop = mechanism.loops()[i];
    if (loop.kind == LoopKind::gear) write_gear(loop, q.data(), v.data(), state);
    if (!is_pair(loop)) continue;
    const FramePair pair(loop, kinematics);
    state.p_WK[i] = pair.p_WFollowerK;
    PairRows(loop, pair, state).write();
  }
  for_each_rope(mechanism, [&](const Loop& loop, std::size_t first) {
    write_rope(loop, kinematics, first, state);
  });
}

void calc_loop_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                        const LoopState& state, const std::vector<int>& slot,
                        Eigen::Ref<Eigen::MatrixXd> jacobian) {
  jacobian.setZero();
  JacobianRows rows(mechanism, kinematics, state, slot, jacobian);
  for (std::size_t i = 0; i < mechanism.loops().size(); ++i) {
    const Loop& loop = mechanism.loops()[i];
    if (loop.kind == LoopKind::gear) rows.gear(loop);
    if (is_pair(loop)) rows.pair(loop, i);
  }
  for_each_rope(mechanism, [&](const Loop& loop, std::size_t first) { rows.rope(loop, first); });
}

Eigen::MatrixXd calc_loop_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                                   const LoopState& state) {
  std::vector<int> slot(index(mechanism.loop_row_count()));
  std::iota(slot.begin(), slot.end(), 0);
  Eigen::MatrixXd jacobian(mechanism.loop_row_count(), mechanism.nv());
  calc_loop_jacobian(mechanism, kinematics, state, slot, jacobian);
  return jacobian;
}

void calc_loop_accelerations(const Mechanism& mechanism, const Kinematics& kinematics,
                             const LoopState& state, ConstVectorRef vdot,
                             const std::vector<MotionVector>& A_WB, VectorRef accelerations) {
  for (const Loop& loop : mechanism.loops()) {
    double& first_row = accelerations[loop.row_offset];
    if (loop.kind == LoopKind::gear) {
      first_row = vdot[loop.first_velocity] - loop.ratio * vdot[loop.second_velocity];
    } else if (loop.kind == LoopKind::rope_length) {
      first_row = rope_acceleration(loop, kinematics, A_WB);
    } else {
      const FramePair pair(loop, kinematics);
      if (loop.kind == LoopKind::distance) {
        const Vector3& direction = state.unit_force_W[loop.row_offset].force;
        first_row = distance_acceleration(loop, pair, kinematics, direction, A_WB);
      } else {
        pair_accelerations(loop, pair, state, A_WB, accelerations);
      }
    }
  }
}

void add_loop_forces(const Mechanism& mechanism, const Kinematics& kinematics,
                     const LoopState& state, ConstVectorRef lambda,
                     std::vector<ForceVector>& F_Bo_W, VectorRef tau) {
  for (std::size_t i = 0; i < mechanism.loops().size(); ++i) {
    const Loop& loop = mechanism.loops()[i];
    if (loop.kind == LoopKind::gear) {
      tau[loop.first_velocity] += lambda[loop.row_offset];
      tau[loop.second_velocity] -= loop.ratio * lambda[loop.row_offset];
    }
    if (!is_pair(loop)) continue;
    const ForceVector F = force_on_follower(loop, state, lambda);
    add_force(kinematics, loop.follower, state.p_WK[i], F, F_Bo_W);
    add_force(kinematics, loop.base, state.p_WK[i], -1.0 * F, F_Bo_W);
  }
  for_each_rope(mechanism, [&](const Loop& loop, std::size_t first) {
    for (const auto& path : loop.paths) {
      for (const Loop::PathPoint& point : path) {
        const Vector3 force = lambda[loop.row_offset] * state.path_direction_W[first++];
        add_point_force(kinematics, point.body, point.p_BoQ_B, force, F_Bo_W);
      }
    }
  });
}

ForceVector loop_force(const Mechanism& mechanism, const Kinematics& kinematics,
                       const LoopState& state, int number, ConstVectorRef lambda) {
  const Loop& wanted = mechanism.loops().at(number);
  if (is_pair(wanted)) {
    ForceVector F = force_on_follower(wanted, state, lambda);
    if (wanted.follower == wanted.second) return F;
    const Vector3 p_WSecondK = point_position(kinematics, wanted.base, wanted.X_BaseK.p);
    return shift_to(-1.0 * F, state.p_WK[number] - p_WSecondK);
  }
  ForceVector result = ForceVector::zero();
  for_each_rope(mechanism, [&](const Loop& loop, std::size_t first) {
    if (&loop != &wanted) return;
    for (const auto& path : loop.paths) first += path.size();
    result.force = lambda[loop.row_offset] * state.path_direction_W[first - 1];
  });
  return result;
}

Mechanism Mechanism::with_loops_as_at(ConstVectorRef q) const {
  Mechanism result = *this;
  Kinematics kinematics(*this);
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(nv());
  compute_kinematics(*this, q, v, kinematics);
  // With lengths and offsets of zero the residual is what they are.
  for (Loop& loop : result.loops_) {
    if (std::isnan(loop.length)) loop.length = 0.0;
    if (std::isnan(loop.offset)) loop.offset = 0.0;
  }
  LoopState state(result);
  compute_loops(result, kinematics, q, v, state);
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    Loop& loop = result.loops_[i];
    const double value = state.residual[loop.row_offset];
    const bool has_length = loop.kind == LoopKind::distance || loop.kind == LoopKind::rope_length;
    loop.length = has_length && std::isnan(loops_[i].length) ? value : loops_[i].length;
    const bool is_gear = loop.kind == LoopKind::gear;
    loop.offset = is_gear && std::isnan(loops_[i].offset) ? value : loops_[i].offset;
  }
  return result;
}

}  // namespace blocklift::dynamics
