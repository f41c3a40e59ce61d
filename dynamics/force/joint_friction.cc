#include "dynamics/force/joint_friction.h"

#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

JointFriction::JointFriction(const Mechanism& mechanism, Definition definition)
    : definition_(std::move(definition)) {
  if (!(definition_.friction >= 0.0) || !std::isfinite(definition_.friction) ||
      !(definition_.creep > 0.0) || !std::isfinite(definition_.creep)) {
    throw ModelError("friction \"" + definition_.name + "\" is " +
                     std::to_string(definition_.friction) + ", full from about the velocity " +
                     std::to_string(definition_.creep) +
                     "; finite numbers are due, the friction zero or more, the velocity above "
                     "zero");
  }
  const Body& body = mechanism.body(definition_.body);
  const int degree = definition_.degree_of_freedom;
  if (degree < 0 || degree >= body.nv() || !velocities_are_rates(body.joint.kind)) {
    throw ModelError("friction \"" + definition_.name + "\" acts at degree of freedom " +
                     std::to_string(degree) + " of the " +
                     std::string(joint_kind_name(body.joint.kind)) + " joint of \"" + body.name +
                     "\"; one is due that has a coordinate of its own, counted from 0");
  }
  v_index_ = body.v_offset + degree;
}

// Of the full friction, against the velocity.
double JointFriction::share(const MotionState& state) const {
  return std::tanh(state.v[v_index_] / definition_.creep);
}

void JointFriction::add_forces(const MotionState& state, Loads& loads) const {
  loads.tau[v_index_] -= definition_.friction * share(state);
}

void JointFriction::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const double s = share(state);
  derivatives.add_joint(v_index_, 0.0, -definition_.friction / definition_.creep * (1.0 - s * s));
}

EnergyAccount JointFriction::calc_energy(const MotionState& state) const {
  return {.dissipated_power = definition_.friction * share(state) * state.v[v_index_]};
}

}  // namespace blocklift::dynamics
