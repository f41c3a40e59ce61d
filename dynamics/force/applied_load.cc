#include "dynamics/force/applied_load.h"

#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

AppliedLoad::AppliedLoad(Definition definition) : definition_(std::move(definition)) {
  if (definition_.point.body == world_index) {
    throw ModelError("load \"" + definition_.name +
                     "\" acts on the world, which nothing moves; name a body");
  }
  if (!definition_.point.p_BoQ_B.allFinite()) {
    throw ModelError("load \"" + definition_.name + "\" needs the point at which it acts");
  }
}

ForceVector AppliedLoad::calc_load(const MotionState& state) const {
  ForceVector load{definition_.moment.evaluate(state.time), definition_.force.evaluate(state.time)};
  if (definition_.axes == Axes::body) {
    const auto& R_WB = state.kinematics.X_WB[definition_.point.body].R;
    load = {R_WB * load.moment, R_WB * load.force};
  }
  return load;
}

void AppliedLoad::add_forces(const MotionState& state, Loads& loads) const {
  loads.F_Bo_W[definition_.point.body] +=
      shift_to(calc_load(state), arm_W(state.kinematics, definition_.point));
}

// With the body's turn dtheta, a load in the body's axes turns by dtheta x load.
void AppliedLoad::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const ForceVector load = calc_load(state);
  derivatives.locate(0, definition_.point.body, arm_W(state.kinematics, definition_.point));
  derivatives.add_held_force(0, load.force);
  if (definition_.axes == Axes::world) return;
  Eigen::Matrix<double, 6, 6> dF_dX = Eigen::Matrix<double, 6, 6>::Zero();
  dF_dX.topLeftCorner<3, 3>() = -skew(load.moment);
  dF_dX.bottomLeftCorner<3, 3>() = -skew(load.force);
  derivatives.add_wrench_block(0, 0, dF_dX, Eigen::Matrix<double, 6, 6>::Zero());
}

EnergyAccount AppliedLoad::calc_energy(const MotionState& state) const {
  const auto body = static_cast<std::size_t>(definition_.point.body);
  const ForceVector load = calc_load(state);
  const MotionVector V_WQ =
      shift(state.kinematics.V_WB[body], arm_W(state.kinematics, definition_.point));
  return {.supplied_power = load.moment.dot(V_WQ.angular) + load.force.dot(V_WQ.linear)};
}

JointLoad::JointLoad(const Mechanism& mechanism, Definition definition)
    : definition_(std::move(definition)) {
  const Body& body = mechanism.body(definition_.body);
  if (definition_.degree_of_freedom < 0 || definition_.degree_of_freedom >= body.nv()) {
    throw ModelError("load \"" + definition_.name + "\" acts at degree of freedom " +
                     std::to_string(definition_.degree_of_freedom) + " of the " +
                     std::string(joint_kind_name(body.joint.kind)) + " joint of \"" + body.name +
                     "\", which has " + std::to_string(body.nv()) + ", counted from 0");
  }
  v_index_ = body.v_offset + definition_.degree_of_freedom;
}

void JointLoad::add_forces(const MotionState& state, Loads& loads) const {
  loads.tau[v_index_] += definition_.load.evaluate(state.time).x();
}

EnergyAccount JointLoad::calc_energy(const MotionState& state) const {
  return {.supplied_power = definition_.load.evaluate(state.time).x() * state.v[v_index_]};
}

}  // namespace blocklift::dynamics
