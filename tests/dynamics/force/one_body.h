#pragma once

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics::test {

/// A free body above the world, and what elements do to it.
struct OneBody {
  OneBody() : mechanism(make()), kinematics(mechanism), loads(mechanism) {
    q = mechanism.zero_configuration();
    v = Eigen::VectorXd::Zero(6);
    update();
  }
  static Mechanism make() {
    MechanismBuilder builder;
    builder.add_body({.name = "body",
                      .joint = {.kind = JointKind::free},
                      .mass = 1.0,
                      .I_BBcm_B = Matrix3::Identity()});
    return builder.build();
  }
  void update() { compute_kinematics(mechanism, q, v, kinematics); }
  MotionState state() const { return {time, q, v, kinematics}; }

  Mechanism mechanism;
  Kinematics kinematics;
  Loads loads;
  Eigen::VectorXd q, v;
  double time = 0.0;
};

/// The account must balance for every element at any motion.
template <ForceElement Element>
void expect_balanced(OneBody& body, const Element& element, double tolerance = 1e-6) {
  body.loads.set_zero();
  element.add_forces(body.state(), body.loads);
  double power = body.loads.tau.dot(body.v);
  for (std::size_t i = 0; i < body.loads.F_Bo_W.size(); ++i) {
    power += dot(body.loads.F_Bo_W[i], body.kinematics.V_WB[i]);
  }
  const EnergyAccount account = element.calc_energy(body.state());
  constexpr double h = 1e-5;
  const Eigen::VectorXd q = body.q;
  std::array<double, 2> stored{};
  for (int side = 0; side < 2; ++side) {
    body.mechanism.integrate(q, body.v, side == 0 ? -h : h, body.q);
    body.update();
    stored[side] = element.calc_energy(body.state()).stored_energy;
  }
  body.q = q;
  body.update();
  const double balance =
      account.supplied_power - account.dissipated_power - (stored[1] - stored[0]) / (2 * h);
  EXPECT_NEAR(power, balance, tolerance * (1.0 + std::abs(power)));
}

}  // namespace blocklift::dynamics::test
