#include "dynamics/force/spring.h"

#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

void require_spring_value(const std::string& spring, const char* what, double value) {
  if (!std::isfinite(value) || value < 0.0) {
    throw ModelError("spring \"" + spring + "\" has the " + what + " " + std::to_string(value) +
                     "; a finite number, zero or more, is due");
  }
}

PointSpring::PointSpring(Definition definition) : definition_(std::move(definition)) {
  require_spring_value(definition_.name, "stiffness", definition_.stiffness);
  require_spring_value(definition_.name, "damping", definition_.damping);
  require_spring_value(definition_.name, "free length", definition_.free_length);
  if (definition_.from.body == definition_.to.body) {
    throw ModelError("spring \"" + definition_.name +
                     "\" has both ends on one body, so it can do nothing; join two bodies");
  }
}

PointSpring::Line PointSpring::calc_line(const MotionState& state) const {
  const BodyPoint& a = definition_.from;
  const BodyPoint& b = definition_.to;
  const Kinematics& k = state.kinematics;
  const Vector3 span = point_position(k, b.body, b.p_BoQ_B) - point_position(k, a.body, a.p_BoQ_B);
  const double length = span.norm();
  if (!(length > 1e-12)) {
    throw ModelError("spring \"" + definition_.name +
                     "\": its ends coincide, so the direction of its force is undefined");
  }
  const Vector3 direction = span / length;
  const Vector3 rate = point_velocity(k, b.body, b.p_BoQ_B) - point_velocity(k, a.body, a.p_BoQ_B);
  return {direction, length, direction.dot(rate)};
}

double PointSpring::calc_tension(const MotionState& state) const {
  const Line line = calc_line(state);
  return definition_.stiffness * (line.length - definition_.free_length) +
         definition_.damping * line.length_rate;
}

void PointSpring::add_forces(const MotionState& state, Loads& loads) const {
  const Line line = calc_line(state);
  const double tension = definition_.stiffness * (line.length - definition_.free_length) +
                         definition_.damping * line.length_rate;
  const Vector3 f_W = tension * line.direction_W;
  add_point_force(state.kinematics, definition_.from.body, definition_.from.p_BoQ_B, f_W,
                  loads.F_Bo_W);
  add_point_force(state.kinematics, definition_.to.body, definition_.to.p_BoQ_B, -f_W,
                  loads.F_Bo_W);
}

void PointSpring::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const BodyPoint& from = definition_.from;
  const BodyPoint& to = definition_.to;
  const Line line = calc_line(state);
  const double tension = definition_.stiffness * (line.length - definition_.free_length) +
                         definition_.damping * line.length_rate;
  const Vector3 relative_velocity = point_velocity(state.kinematics, to.body, to.p_BoQ_B) -
                                    point_velocity(state.kinematics, from.body, from.p_BoQ_B);
  derivatives.locate(0, from.body, arm_W(state.kinematics, from));
  derivatives.locate(1, to.body, arm_W(state.kinematics, to));
  derivatives.add_tension(0, 1, {line.direction_W, line.length, relative_velocity}, tension,
                          definition_.stiffness, definition_.damping);
}

EnergyAccount PointSpring::calc_energy(const MotionState& state) const {
  const Line line = calc_line(state);
  const double elongation = line.length - definition_.free_length;
  return {.stored_energy = 0.5 * definition_.stiffness * elongation * elongation,
          .dissipated_power = definition_.damping * line.length_rate * line.length_rate};
}

JointSpring::JointSpring(const Mechanism& mechanism, Definition definition)
    : definition_(std::move(definition)) {
  require_spring_value(definition_.name, "stiffness", definition_.stiffness);
  require_spring_value(definition_.name, "damping", definition_.damping);
  if (!std::isfinite(definition_.free_coordinate)) {
    throw ModelError("spring \"" + definition_.name +
                     "\" needs the joint coordinate at which it is free of force");
  }
  const Body& body = mechanism.body(definition_.body);
  const int degree = definition_.degree_of_freedom;
  if (degree < 0 || degree >= body.nv() || !velocities_are_rates(body.joint.kind)) {
    throw ModelError("spring \"" + definition_.name + "\" acts at degree of freedom " +
                     std::to_string(degree) + " of the " +
                     std::string(joint_kind_name(body.joint.kind)) + " joint of \"" + body.name +
                     "\"; one is due that has a coordinate of its own, counted from 0");
  }
  q_index_ = body.q_offset + degree;
  v_index_ = body.v_offset + degree;
}

void JointSpring::add_forces(const MotionState& state, Loads& loads) const {
  loads.tau[v_index_] -= definition_.stiffness * (state.q[q_index_] - definition_.free_coordinate) +
                         definition_.damping * state.v[v_index_];
}

void JointSpring::add_derivatives(const MotionState&, ForceDerivatives& derivatives) const {
  derivatives.add_joint(v_index_, -definition_.stiffness, -definition_.damping);
}

EnergyAccount JointSpring::calc_energy(const MotionState& state) const {
  const double deflection = state.q[q_index_] - definition_.free_coordinate;
  const double rate = state.v[v_index_];
  return {.stored_energy = 0.5 * definition_.stiffness * deflection * deflection,
          .dissipated_power = definition_.damping * rate * rate};
}

}  // namespace blocklift::dynamics
