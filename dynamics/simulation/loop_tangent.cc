#include "dynamics/simulation/loop_tangent.h"

#include <algorithm>

namespace blocklift::dynamics {

LoopTangent::LoopTangent(const LiftSystem& system)
    : slot_(static_cast<std::size_t>(system.mechanism().loop_row_count())),
      kinematics_(system.mechanism()),
      state_(system.mechanism()),
      A_WB_(static_cast<std::size_t>(system.mechanism().body_count())),
      q_(system.mechanism().nq()),
      v_(Eigen::VectorXd::Zero(system.mechanism().nv())),
      a_(Eigen::VectorXd::Zero(system.mechanism().loop_row_count())),
      a_here_(a_),
      whole_(system.mechanism().loop_row_count(), system.mechanism().nv()),
      jacobian_(system.mechanism().loop_row_count(), system.nv_free()),
      by_q_(jacobian_),
      by_v_(jacobian_) {}

// The first rank() pivots of the factorisation that the accelerations have come from.
void LoopTangent::choose_rows(const LiftWorkspace& w) {
  const LoopRows& solved = w.loop_rows ? *w.loop_rows : w.loops->all_rows;
  std::fill(slot_.begin(), slot_.end(), -1);
  count_ = w.loops->rank;
  for (Eigen::Index i = 0; i < count_; ++i) {
    const int pivot = w.loops->qr.pivots()[i];
    slot_[solved.rows[pivot]] = static_cast<int>(i);
  }
}

void LoopTangent::accelerations(const Mechanism& mechanism, ConstVectorRef q, ConstVectorRef v,
                                ConstVectorRef vdot) {
  compute_kinematics(mechanism, q, v, kinematics_);
  compute_accelerations(mechanism, kinematics_, vdot, A_WB_);
  compute_loops(mechanism, kinematics_, q, v, state_);
  calc_loop_accelerations(mechanism, kinematics_, state_, vdot, A_WB_, a_);
}

void LoopTangent::calc(const LiftSystem& system, const LiftWorkspace& w) {
  constexpr double step = 1e-7;  // m, rad; relative to 1 or the value for velocities
  const Mechanism& mechanism = system.mechanism();
  choose_rows(w);
  calc_loop_jacobian(mechanism, w.kinematics, w.loops->loops, slot_, whole_.topRows(count_));
  accelerations(mechanism, w.q, w.v, w.vdot);
  a_here_ = a_;
  const auto write = [&](Eigen::MatrixXd& matrix, Eigen::Index column, double h) {
    for (std::size_t row = 0; row < slot_.size(); ++row) {
      if (slot_[row] < 0) continue;
      const auto i = static_cast<Eigen::Index>(row);
      matrix(slot_[row], column) = (a_[i] - a_here_[i]) / h;
    }
  };
  Eigen::Index column = 0;
  for (const int k : mechanism.free_velocities()) {
    jacobian_.col(column).head(count_) = whole_.col(k).head(count_);
    v_.setZero();
    v_[k] = 1.0;
    mechanism.integrate(w.q, v_, step, q_);
    accelerations(mechanism, q_, w.v, w.vdot);
    write(by_q_, column, step);
    const double h = step * std::max(1.0, std::abs(w.v[k]));
    v_ = w.v;
    v_[k] += h;
    accelerations(mechanism, w.q, v_, w.vdot);
    write(by_v_, column, h);
    ++column;
  }
}

}  // namespace blocklift::dynamics
