#include "dynamics/force/wind_load.h"

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

FlowCoefficients make_coefficients(const WindLoad::Definition& d) {
  const std::string who = "wind load \"" + d.name + "\"";
  if (!d.wind) throw ModelError(who + " needs a wind");
  if (d.reference.body <= world_index) throw ModelError(who + " acts on no body that moves");
  return {who, {d.frontal_area, d.lateral_area, d.height, d.length, d.table}};
}

}  // namespace

WindLoad::WindLoad(Definition definition)
    : definition_(std::move(definition)), coefficients_(make_coefficients(definition_)) {}

WindLoad::Air WindLoad::find_air(const MotionState& state) const {
  const BodyPoint& P = definition_.reference;
  const Pose& X_WB = state.kinematics.X_WB[P.body];
  Air air;
  air.r_W = X_WB.R * P.p_BoQ_B;
  const double z = X_WB.p.z() + air.r_W.z();
  air.u_W = definition_.wind->calc_velocity(state.time, z) -
            point_velocity(state.kinematics, P.body, P.p_BoQ_B);
  air.load = coefficients_.calc_load(definition_.wind->air_density(), X_WB.R.transpose() * air.u_W);
  return air;
}

ForceVector WindLoad::calc_force(const MotionState& state) const {
  const Air air = find_air(state);
  const Matrix3& R = state.kinematics.X_WB[definition_.reference.body].R;
  return {R * air.load.F_B.head<3>(), R * air.load.F_B.tail<3>()};
}

void WindLoad::add_forces(const MotionState& state, Loads& loads) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  loads.F_Bo_W[body] += shift_to(calc_force(state), r_W);
}

void WindLoad::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Air air = find_air(state);
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const FlowLoad flow(air.load, state.kinematics.X_WB[body].R, air.u_W);
  derivatives.locate(0, definition_.reference.body, air.r_W);
  derivatives.add_held_force(0, flow.F_W.force);
  derivatives.add_wrench_block(0, 0, flow.dF_dX, flow.dF_dV);
}

EnergyAccount WindLoad::calc_energy(const MotionState& state) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  return {.supplied_power = dot(shift_to(calc_force(state), r_W), state.kinematics.V_WB[body])};
}

}  // namespace blocklift::dynamics
