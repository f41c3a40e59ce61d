#pragma once

#include "dynamics/multibody/forward_dynamics.h"

namespace blocklift::dynamics::test {

/// Classical Runge-Kutta integration of a mechanism without drives and external forces, with a
/// fixed step: for tests only, so that the kernel is seen without the library's own integrator.
class RungeKutta {
 public:
  RungeKutta(const Mechanism& mechanism, Eigen::VectorXd q, Eigen::VectorXd v)
      : q(std::move(q)),
        v(std::move(v)),
        mechanism_(mechanism),
        kinematics_(mechanism),
        workspace_(mechanism),
        forces_(static_cast<std::size_t>(mechanism.body_count()), ForceVector::zero()),
        tau_(Eigen::VectorXd::Zero(mechanism.nv())),
        q_stage_(mechanism.nq()),
        v_stage_(mechanism.nv()),
        q_rate_(mechanism.nq(), 4),
        v_rate_(mechanism.nv(), 4) {}

  void advance(double duration, int steps) {
    const double h = duration / steps;
    for (int i = 0; i < steps; ++i) step(h);
  }

  Kinematics kinematics() const {
    Kinematics result(mechanism_);
    compute_kinematics(mechanism_, q, v, result);
    return result;
  }

  Eigen::VectorXd q, v;

 private:
  void step(double h) {
    const double reach[] = {0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
      q_stage_ = q;
      v_stage_ = v;
      if (stage > 0) {
        q_stage_ += reach[stage] * h * q_rate_.col(stage - 1);
        v_stage_ += reach[stage] * h * v_rate_.col(stage - 1);
      }
      compute_kinematics(mechanism_, q_stage_, v_stage_, kinematics_);
      compute_forward_dynamics(mechanism_, kinematics_, v_stage_, forces_, workspace_, tau_,
                               v_rate_.col(stage));
      mechanism_.calc_rates(q_stage_, v_stage_, q_rate_.col(stage));
    }
    q += h / 6 * (q_rate_.col(0) + 2 * q_rate_.col(1) + 2 * q_rate_.col(2) + q_rate_.col(3));
    v += h / 6 * (v_rate_.col(0) + 2 * v_rate_.col(1) + 2 * v_rate_.col(2) + v_rate_.col(3));
    mechanism_.normalise(q);
  }

  const Mechanism& mechanism_;
  Kinematics kinematics_;
  ForwardDynamicsWorkspace workspace_;
  std::vector<ForceVector> forces_;
  Eigen::VectorXd tau_, q_stage_, v_stage_;
  Eigen::MatrixXd q_rate_, v_rate_;
};

}  // namespace blocklift::dynamics::test
