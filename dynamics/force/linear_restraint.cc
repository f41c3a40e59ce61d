#include "dynamics/force/linear_restraint.h"

#include <cmath>

#include <Eigen/Core>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"
#include "dynamics/spatial/rotation_vector.h"

namespace blocklift::dynamics {
namespace {

// J^-T(theta) g = g + theta x g / 2 + s theta x (theta x g), s of the angle: how it changes with
// theta while g is held.
Matrix3 derivative_of_moment(const Vector3& theta, const Vector3& g) {
  const double angle = theta.norm(), half = 0.5 * angle;
  double s = 1.0 / 12.0 + angle * angle / 720.0;
  double slope_over_angle = 1.0 / 360.0 + angle * angle / 7560.0;  // ds/d(angle) / angle
  if (angle > 5e-2) {
    const double cotangent = 1.0 / std::tan(half), sine = std::sin(half);
    s = (1.0 - half * cotangent) / (angle * angle);
    slope_over_angle =
        (0.25 / (sine * sine) + (0.5 * cotangent - 2.0 / angle) / angle) / (angle * angle);
  }
  const Vector3 once = theta.cross(g);
  return -0.5 * skew(g) - s * (skew(once) + skew(theta) * skew(g)) +
         slope_over_angle * theta.cross(once) * theta.transpose();
}

}  // namespace

bool LinearRestraint::adds_energy(const Matrix6& damping) {
  // Lengths and angles have different units: each freedom is first scaled by its own damping.
  const Matrix6 symmetric = 0.5 * (damping + damping.transpose());
  const Vector6 scale =
      symmetric.diagonal().unaryExpr([](double c) { return c > 0.0 ? 1.0 / std::sqrt(c) : 1.0; });
  const Matrix6 scaled = scale.asDiagonal() * symmetric * scale.asDiagonal();
  return algebra::symmetric_eigenvalues(scaled)[0] < -1e-9;
}

LinearRestraint::LinearRestraint(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  if (!d.stiffness.allFinite() || !d.damping.allFinite()) {
    throw ModelError("restraint \"" + d.name + "\" has a stiffness or damping that is not finite");
  }
  if (d.point.body <= world_index) {
    throw ModelError("restraint \"" + d.name + "\" holds no body that moves");
  }
  if (adds_energy(d.damping)) {
    throw ModelError("restraint \"" + d.name +
                     "\" has a damping that adds energy in some motions; its symmetric part must "
                     "have no negative eigenvalue");
  }
}

LinearRestraint::Shift LinearRestraint::calc_shift(const MotionState& state) const {
  const Definition& d = definition_;
  const auto body = static_cast<std::size_t>(d.point.body);
  const Pose& X_WB = state.kinematics.X_WB[body];
  const Matrix3 R_RW = d.X_WR.R.transpose();
  Shift shifted;
  shifted.p_BoP_W = X_WB.R * d.point.p_BoQ_B;
  const Vector3 theta = rotation_vector(quaternion_from_rotation(R_RW * X_WB.R));
  shifted.x << theta, R_RW * (X_WB.p + shifted.p_BoP_W - d.X_WR.p);
  const MotionVector V_P_W = shift(state.kinematics.V_WB[body], shifted.p_BoP_W);
  shifted.V << R_RW * V_P_W.angular, R_RW * V_P_W.linear;
  shifted.growth = inverse_left_jacobian(theta);
  shifted.spring = -d.stiffness * shifted.x;
  shifted.spring.head<3>() = (shifted.growth.transpose() * shifted.spring.head<3>()).eval();
  shifted.damper = -d.damping * shifted.V;
  return shifted;
}

void LinearRestraint::add_forces(const MotionState& state, Loads& loads) const {
  const Shift shifted = calc_shift(state);
  const Vector6 F_R = shifted.spring + shifted.damper;
  const Matrix3& R = definition_.X_WR.R;
  loads.F_Bo_W[definition_.point.body] +=
      shift_to(ForceVector{R * F_R.head<3>(), R * F_R.tail<3>()}, shifted.p_BoP_W);
}

void LinearRestraint::add_derivatives(const MotionState& state,
                                      ForceDerivatives& derivatives) const {
  const Definition& d = definition_;
  const Shift shifted = calc_shift(state);
  // By x first; a turn of the body changes theta by J^-1.
  Matrix6 by_x = -d.stiffness;
  by_x.topRows<3>() = (shifted.growth.transpose() * by_x.topRows<3>()).eval();
  const Vector3 held = -d.stiffness.topRows<3>() * shifted.x;
  by_x.topLeftCorner<3, 3>() += derivative_of_moment(shifted.x.head<3>(), held);
  by_x.leftCols<3>() = (by_x.leftCols<3>() * shifted.growth).eval();
  Matrix6 R = Matrix6::Zero();
  R.topLeftCorner<3, 3>() = d.X_WR.R;
  R.bottomRightCorner<3, 3>() = d.X_WR.R;
  derivatives.locate(0, d.point.body, shifted.p_BoP_W);
  derivatives.add_held_force(0, d.X_WR.R * (shifted.spring + shifted.damper).tail<3>());
  derivatives.add_wrench_block(0, 0, R * by_x * R.transpose(), -R * d.damping * R.transpose(),
                               true);
}

EnergyAccount LinearRestraint::calc_energy(const MotionState& state) const {
  const Shift shifted = calc_shift(state);
  const Matrix6& K = definition_.stiffness;
  const Vector6 turning = -0.5 * (K - K.transpose()) * shifted.x;
  Vector6 rate = shifted.V;
  rate.head<3>() = shifted.growth * rate.head<3>();
  return {.stored_energy = 0.5 * shifted.x.dot(K * shifted.x),
          .dissipated_power = -shifted.damper.dot(shifted.V),
          .supplied_power = turning.dot(rate)};
}

}  // namespace blocklift::dynamics
