#include "dynamics/marine/loads/current_load.h"

#include <algorithm>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hydrostatics.h"

namespace blocklift::dynamics {
namespace {

FlowCoefficients make_current_coefficients(const CurrentLoad::Definition& d) {
  const std::string who = "current load \"" + d.name + "\"";
  if (!d.sea) throw ModelError(who + " needs a sea");
  if (d.reference.body <= world_index) throw ModelError(who + " acts on no body that moves");
  if (d.hull && !(d.reference_volume > 0.0)) {
    throw ModelError(who + " has the reference volume " + std::to_string(d.reference_volume) +
                     " m3; what the hull displaces afloat is due, a number above zero");
  }
  return {who, d.coefficients};
}

}  // namespace

CurrentLoad::CurrentLoad(Definition definition)
    : definition_(std::move(definition)), coefficients_(make_current_coefficients(definition_)) {}

CurrentLoad::Flow CurrentLoad::find_flow(const MotionState& state) const {
  const Definition& d = definition_;
  const Pose& X_WB = state.kinematics.X_WB[d.reference.body];
  Flow flow;
  flow.p_BoP_W = X_WB.R * d.reference.p_BoQ_B;
  flow.u_W = d.sea->current.calc_velocity(X_WB.p.z() + flow.p_BoP_W.z()) -
             point_velocity(state.kinematics, d.reference.body, d.reference.p_BoQ_B);
  flow.load = coefficients_.calc_load(d.sea->water().density, X_WB.R.transpose() * flow.u_W);
  flow.wet = 1.0;
  if (d.hull) {
    flow.wet = std::clamp(calc_displaced_volume(*d.hull, X_WB) / d.reference_volume, 0.0, 1.0);
  }
  return flow;
}

ForceVector CurrentLoad::calc_force(const MotionState& state) const {
  const Flow flow = find_flow(state);
  const Matrix3& R = state.kinematics.X_WB[definition_.reference.body].R;
  return {flow.wet * (R * flow.load.F_B.head<3>()), flow.wet * (R * flow.load.F_B.tail<3>())};
}

void CurrentLoad::add_forces(const MotionState& state, Loads& loads) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  loads.F_Bo_W[body] += shift_to(calc_force(state), r_W);
}

void CurrentLoad::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Definition& d = definition_;
  const Flow flow = find_flow(state);
  const Pose& X_WB = state.kinematics.X_WB[d.reference.body];
  const FlowLoad whole(flow.load, X_WB.R, flow.u_W);
  Eigen::Matrix<double, 6, 6> dF_dX = flow.wet * whole.dF_dX;
  if (d.hull && flow.wet > 0.0 && flow.wet < 1.0) {
    // Row 6 of the stiffness is the loss of volume with the motion of Bo; Bo = P - p_BoP.
    const Eigen::Matrix<double, 1, 6> loss =
        calc_stiffness_over_rho_g(calc_hydrostatics(*d.hull, X_WB)).row(5);
    Eigen::Matrix<double, 1, 6> at_P = loss;
    at_P.head<3>() += loss.tail<3>() * skew(flow.p_BoP_W);
    Eigen::Matrix<double, 6, 1> F_W;
    F_W << whole.F_W.moment, whole.F_W.force;
    dF_dX -= F_W * at_P / d.reference_volume;
  }
  derivatives.locate(0, d.reference.body, flow.p_BoP_W);
  derivatives.add_held_force(0, flow.wet * whole.F_W.force);
  derivatives.add_wrench_block(0, 0, dF_dX, flow.wet * whole.dF_dV);
}

EnergyAccount CurrentLoad::calc_energy(const MotionState& state) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  return {.supplied_power = dot(shift_to(calc_force(state), r_W), state.kinematics.V_WB[body])};
}

}  // namespace blocklift::dynamics
