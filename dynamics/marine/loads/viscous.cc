#include "dynamics/marine/loads/viscous.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hydrostatics.h"

namespace blocklift::dynamics {

MorisonMember::MorisonMember(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  const auto require = [&](const char* what, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw ModelError("member \"" + d.name + "\" has the " + what + " " + std::to_string(value) +
                     "; a finite number, zero or more, is due");
  };
  if (d.body <= world_index) {
    throw ModelError("member \"" + d.name + "\" belongs to no body that moves");
  }
  require("diameter", d.diameter);
  require("drag coefficient", d.drag_coefficient);
  if (!((d.p_BoQ_B - d.p_BoP_B).norm() > 0.0)) {
    throw ModelError("member \"" + d.name + "\" has no length: its two ends coincide");
  }
  if (d.segments < 1) throw ModelError("member \"" + d.name + "\" needs one segment or more");
  if (!d.sea) throw ModelError("member \"" + d.name + "\" needs a sea");
}

template <class Function>
void MorisonMember::for_each_wet_point(const MotionState& state, Function&& at) const {
  const Definition& d = definition_;
  const auto body = static_cast<std::size_t>(d.body);
  const Pose& X_WB = state.kinematics.X_WB[body];
  const MotionVector& V_WB = state.kinematics.V_WB[body];
  const Vector3 p = X_WB.R * d.p_BoP_B;  // from Bo, in W
  const Vector3 span = X_WB.R * (d.p_BoQ_B - d.p_BoP_B);
  const double piece = span.norm() / d.segments;
  const auto depth_at = [&](const Vector3& r) {
    const Vector3 place = X_WB.p + r;
    return d.sea->calc_elevation(state.time, place.x(), place.y()) - place.z();
  };
  Vector3 from = p;
  double depth_from = depth_at(from);
  for (int i = 1; i <= d.segments; ++i) {
    const Vector3 to = p + span * (static_cast<double>(i) / d.segments);
    const double depth_to = depth_at(to);
    if (depth_from > 0.0 || depth_to > 0.0) {
      // The wet part of the piece, from the fraction a to the fraction b.
      const double cut = depth_from / (depth_from - depth_to);
      const double a = depth_from > 0.0 ? 0.0 : cut;
      const double b = depth_to > 0.0 ? 1.0 : cut;
      for (const double gauss : {-0.5773502691896257, 0.5773502691896257}) {
        const Vector3 r = from + (0.5 * (a + b) + 0.5 * (b - a) * gauss) * (to - from);
        const Vector3 u = d.sea->calc_velocity(state.time, X_WB.p + r) - shift(V_WB, r).linear;
        at(r, u, 0.5 * (b - a) * piece);
      }
    }
    from = to;
    depth_from = depth_to;
  }
}

ForceVector MorisonMember::calc_force(const MotionState& state) const {
  const Definition& d = definition_;
  const Matrix3& R = state.kinematics.X_WB[d.body].R;
  const Vector3 axis = R * (d.p_BoQ_B - d.p_BoP_B).normalized();
  const double scale = 0.5 * d.sea->water().density * d.drag_coefficient * d.diameter;
  ForceVector F = ForceVector::zero();
  for_each_wet_point(state, [&](const Vector3& r, const Vector3& u, double length) {
    const Vector3 normal = u - axis.dot(u) * axis;
    F += shift_to({Vector3::Zero(), length * scale * normal.norm() * normal}, r);
  });
  return F;
}

void MorisonMember::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Definition& d = definition_;
  const auto body = static_cast<std::size_t>(d.body);
  const Vector3 axis = state.kinematics.X_WB[body].R * (d.p_BoQ_B - d.p_BoP_B).normalized();
  const Matrix3 across = Matrix3::Identity() - axis * axis.transpose();
  const Matrix3 spin = skew(state.kinematics.V_WB[body].angular);
  const double scale = 0.5 * d.sea->water().density * d.drag_coefficient * d.diameter;
  Eigen::Matrix<double, 6, 6> dF_dX = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> dF_dV = Eigen::Matrix<double, 6, 6>::Zero();
  for_each_wet_point(state, [&](const Vector3& r, const Vector3& u, double length) {
    const Vector3 n = across * u;
    const double speed = n.norm();
    if (speed == 0.0) return;
    const Matrix3 by_n = length * scale * (speed * Matrix3::Identity() + n * n.transpose() / speed);
    const Vector3 f = length * scale * speed * n;
    // n = u - (a.u) a with da = dtheta x a, du = -dv - dw x r - w x (dtheta x r).
    const Matrix3 n_by_turn =
        axis.dot(u) * skew(axis) + axis * (u.transpose() * skew(axis)) + across * spin * skew(r);
    const Matrix3 f_by_turn = by_n * n_by_turn;
    const Matrix3 f_by_v = -by_n * across;
    const Matrix3 arm = skew(r);
    dF_dX.topLeftCorner<3, 3>() += arm * f_by_turn + skew(f) * arm;
    dF_dX.bottomLeftCorner<3, 3>() += f_by_turn;
    dF_dV.topLeftCorner<3, 3>() -= arm * f_by_v * arm;
    dF_dV.bottomLeftCorner<3, 3>() -= f_by_v * arm;
    dF_dV.topRightCorner<3, 3>() += arm * f_by_v;
    dF_dV.bottomRightCorner<3, 3>() += f_by_v;
  });
  derivatives.locate(0, d.body, Vector3::Zero());
  derivatives.add_wrench_block(0, 0, dF_dX, dF_dV);
}

void MorisonMember::add_forces(const MotionState& state, Loads& loads) const {
  loads.F_Bo_W[definition_.body] += calc_force(state);
}

EnergyAccount MorisonMember::calc_energy(const MotionState& state) const {
  const MotionVector& V = state.kinematics.V_WB[definition_.body];
  return {.supplied_power = dot(calc_force(state), V)};
}

QuadraticDamping::QuadraticDamping(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  for (const Vector6* values : {&d.linear, &d.quadratic}) {
    if (values->allFinite() && values->minCoeff() >= 0.0) continue;
    throw ModelError("damping \"" + d.name +
                     "\" has a coefficient that is negative or not finite; six numbers, zero or "
                     "more, are due");
  }
  if (d.point.body <= world_index) {
    throw ModelError("damping \"" + d.name + "\" brakes no body that moves");
  }
  if (!d.sea) throw ModelError("damping \"" + d.name + "\" needs a sea");
  if (d.hull && !(d.reference_volume > 0.0)) {
    throw ModelError("damping \"" + d.name + "\" has the reference volume " +
                     std::to_string(d.reference_volume) +
                     " m3; what the hull displaces afloat is due, a number above zero");
  }
}

QuadraticDamping::Drag QuadraticDamping::calc_drag(const MotionState& state) const {
  const Definition& d = definition_;
  const auto body = static_cast<std::size_t>(d.point.body);
  const Pose& X_WB = state.kinematics.X_WB[body];
  Drag drag;
  drag.p_BoP_W = X_WB.R * d.point.p_BoQ_B;
  drag.V_P_W = shift(state.kinematics.V_WB[body], drag.p_BoP_W);
  const Vector3 place = X_WB.p + drag.p_BoP_W;
  drag.relative_W = {drag.V_P_W.angular,
                     drag.V_P_W.linear - d.sea->current.calc_velocity(place.z())};
  drag.V_B << X_WB.R.transpose() * drag.relative_W.angular,
      X_WB.R.transpose() * drag.relative_W.linear;
  drag.wet = 1.0;
  if (d.hull) {
    const double volume = calc_displaced_volume(*d.hull, X_WB);
    drag.wet = std::clamp(volume / d.reference_volume, 0.0, 1.0);
  }
  drag.F_B = -(d.linear.array() * drag.V_B.array() +
               d.quadratic.array() * drag.V_B.array() * drag.V_B.array().abs());
  drag.F_P_W = {drag.wet * (X_WB.R * drag.F_B.head<3>()), drag.wet * (X_WB.R * drag.F_B.tail<3>())};
  return drag;
}

void QuadraticDamping::add_forces(const MotionState& state, Loads& loads) const {
  const Drag drag = calc_drag(state);
  loads.F_Bo_W[definition_.point.body] += shift_to(drag.F_P_W, drag.p_BoP_W);
}

void QuadraticDamping::add_derivatives(const MotionState& state,
                                       ForceDerivatives& derivatives) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Definition& d = definition_;
  const Drag drag = calc_drag(state);
  const Pose& X_WB = state.kinematics.X_WB[d.point.body];
  Matrix6 R = Matrix6::Zero();
  R.topLeftCorner<3, 3>() = X_WB.R;
  R.bottomRightCorner<3, 3>() = X_WB.R;
  const Vector6 slope = d.linear.array() + 2.0 * d.quadratic.array() * drag.V_B.array().abs();
  const Matrix6 dF_dV = -drag.wet * R * slope.asDiagonal() * R.transpose();
  // F = R F_B(R^T V): the axes turn under a velocity and a force that are held.
  Matrix6 dF_dX = Matrix6::Zero();
  dF_dX.leftCols<3>() << -skew(drag.F_P_W.moment), -skew(drag.F_P_W.force);
  Eigen::Matrix<double, 6, 3> turned;
  turned << skew(drag.relative_W.angular), skew(drag.relative_W.linear);
  dF_dX.leftCols<3>() += dF_dV * turned;
  if (d.hull && drag.wet > 0.0 && drag.wet < 1.0) {
    // Row 6 of the stiffness is the loss of volume with the motion of Bo; Bo = P - p_BoP.
    const Eigen::Matrix<double, 1, 6> loss =
        calc_stiffness_over_rho_g(calc_hydrostatics(*d.hull, X_WB)).row(5);
    Eigen::Matrix<double, 1, 6> at_P = loss;
    at_P.head<3>() += loss.tail<3>() * skew(drag.p_BoP_W);
    dF_dX -= (R * drag.F_B) * at_P / d.reference_volume;
  }
  derivatives.locate(0, d.point.body, drag.p_BoP_W);
  derivatives.add_held_force(0, drag.F_P_W.force);
  derivatives.add_wrench_block(0, 0, dF_dX, dF_dV);
}

EnergyAccount QuadraticDamping::calc_energy(const MotionState& state) const {
  const Drag drag = calc_drag(state);
  const double dissipated = -dot(drag.F_P_W, drag.relative_W);
  return {.dissipated_power = dissipated,
          .supplied_power = dot(drag.F_P_W, drag.V_P_W) + dissipated};
}

}  // namespace blocklift::dynamics
