#include "dynamics/force/force_derivatives.h"

namespace blocklift::dynamics {

ForceDerivatives::ForceDerivatives(const Mechanism& mechanism, std::size_t most_points)
    : mechanism_(&mechanism),
      points_(std::max<std::size_t>(1, most_points)),
      arm_moments_(static_cast<std::size_t>(mechanism.body_count()), Matrix3::Zero()),
      dtau_dq_(Eigen::MatrixXd::Zero(mechanism.nv(), mechanism.nv())),
      dtau_dv_(Eigen::MatrixXd::Zero(mechanism.nv(), mechanism.nv())) {
  for (Point& point : points_) {
    point.velocity.resize(mechanism.nv());
    for (auto* matrix : {&point.turn, &point.p, &point.w_q, &point.v_q}) {
      matrix->resize(3, mechanism.nv());
    }
  }
}

void ForceDerivatives::start(const Kinematics& kinematics, const MotionColumns& columns,
                             bool stretch_only) {
  stretch_only_ = stretch_only;
  kinematics_ = &kinematics;
  columns_ = &columns;
  dtau_dq_.setZero();
  dtau_dv_.setZero();
  for (Matrix3& arm : arm_moments_) arm.setZero();
}

void ForceDerivatives::locate(std::size_t slot, BodyIndex body, const Vector3& r_W) {
  Point& point = points_[slot];
  point.body = body;
  point.r_W = r_W;
  point.count = 0;
  const auto b = static_cast<std::size_t>(body);
  const Vector3 p_OQ = kinematics_->X_WB[b].p + r_W - columns_->p_WO;
  const Vector3& w = kinematics_->V_WB[b].angular;
  const Vector3 v = kinematics_->V_WB[b].linear + w.cross(r_W);
  for (BodyIndex i = body; i != world_index;) {
    const Body& mover = mechanism_->bodies()[i];
    for (int k = mover.v_offset; k < mover.v_offset + mover.nv(); ++k) {
      const MotionVector& S = columns_->S[k];
      const MotionVector& swing = columns_->S_swing[k];
      const Eigen::Index c = point.count++;
      point.velocity[c] = k;
      point.turn.col(c) = S.angular;
      point.p.col(c) = S.linear + S.angular.cross(p_OQ);
      // Carried round with the column, and as the column's own place moves on.
      point.w_q.col(c) = S.angular.cross(w) + swing.angular;
      point.v_q.col(c) = S.angular.cross(v) + swing.linear + swing.angular.cross(p_OQ);
    }
    i = mover.carrier;
  }
}

void ForceDerivatives::add_held_force(std::size_t slot, const Vector3& f_W) {
  if (stretch_only_) return;
  const Point& point = points_[slot];
  arm_moments_[point.body] += skew(f_W) * skew(point.r_W);
}

void ForceDerivatives::add_block(std::size_t on, std::size_t by, const Matrix3& df_dp,
                                 const Matrix3& df_dv) {
  const Point& a = points_[on];
  const Point& b = points_[by];
  for (int j = 0; j < b.count; ++j) {
    const Vector3 by_v = df_dv * b.p.col(j);
    const Vector3 by_q = df_dp * b.p.col(j) + df_dv * b.v_q.col(j);
    const int column = b.velocity[j];
    for (int i = 0; i < a.count; ++i) {
      const int row = a.velocity[i];
      dtau_dq_(row, column) += a.p.col(i).dot(by_q);
      dtau_dv_(row, column) += a.p.col(i).dot(by_v);
    }
  }
}

void ForceDerivatives::add_line(std::size_t from, std::size_t to, const Matrix3& df_dx,
                                const Matrix3& df_dv) {
  add_block(from, from, -df_dx, -df_dv);
  add_block(from, to, df_dx, df_dv);
  add_block(to, from, df_dx, df_dv);
  add_block(to, to, -df_dx, -df_dv);
}

void ForceDerivatives::add_tension(std::size_t from, std::size_t to, const Line& line,
                                   double tension, double dT_dL, double dT_dLdot) {
  const Vector3& u = line.direction_W;
  const Matrix3 along = u * u.transpose();
  const Matrix3 across = (Matrix3::Identity() - along) / line.length;
  const Matrix3 K = dT_dL * along + (stretch_only_ ? 0.0 : tension) * across +
                    dT_dLdot * u * (across * line.relative_velocity_W).transpose();
  add_line(from, to, K, dT_dLdot * along);
  add_held_force(from, tension * u);
  add_held_force(to, -tension * u);
}

void ForceDerivatives::add_turning(std::size_t slot, const Matrix3& df_dtheta) {
  if (stretch_only_) return;
  const Point& point = points_[slot];
  for (int j = 0; j < point.count; ++j) {
    const Vector3 by_q = df_dtheta * point.turn.col(j);
    const int column = point.velocity[j];
    for (int i = 0; i < point.count; ++i) {
      dtau_dq_(point.velocity[i], column) += point.p.col(i).dot(by_q);
    }
  }
}

void ForceDerivatives::add_motion(std::size_t slot, const Vector3& rate_W,
                                  Eigen::Ref<Eigen::MatrixXd> p,
                                  Eigen::Ref<Eigen::MatrixXd> v_q) const {
  const Point& point = points_[slot];
  for (int j = 0; j < point.count; ++j) {
    const int column = point.velocity[j];
    p.col(column) += point.p.col(j);
    v_q.col(column) += point.v_q.col(j) + point.turn.col(j).cross(rate_W);
  }
}

void ForceDerivatives::add_turn(std::size_t slot, Eigen::Ref<Eigen::MatrixXd> turn) const {
  const Point& point = points_[slot];
  for (int j = 0; j < point.count; ++j) turn.col(point.velocity[j]) += point.turn.col(j);
}

void ForceDerivatives::add_wrench_block(std::size_t on, std::size_t by,
                                        const Eigen::Matrix<double, 6, 6>& dF_dX,
                                        const Eigen::Matrix<double, 6, 6>& dF_dV, bool stretches) {
  if (stretch_only_ && !stretches) return;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const Point& a = points_[on];
  const Point& b = points_[by];
  for (int j = 0; j < b.count; ++j) {
    Vector6 X, V;
    X << b.turn.col(j), b.p.col(j);
    V << b.w_q.col(j), b.v_q.col(j);
    const Vector6 by_v = dF_dV * X;
    const Vector6 by_q = dF_dX * X + dF_dV * V;
    const int column = b.velocity[j];
    for (int i = 0; i < a.count; ++i) {
      const int row = a.velocity[i];
      dtau_dq_(row, column) += a.turn.col(i).dot(by_q.head<3>()) + a.p.col(i).dot(by_q.tail<3>());
      dtau_dv_(row, column) += a.turn.col(i).dot(by_v.head<3>()) + a.p.col(i).dot(by_v.tail<3>());
    }
  }
}

}  // namespace blocklift::dynamics
