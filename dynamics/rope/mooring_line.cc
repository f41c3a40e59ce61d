#include "dynamics/rope/mooring_line.h"

#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

MooringLine::MooringLine(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  require_line(d.line, d.name);
  if (d.anchor.body == d.fairlead.body) {
    throw ModelError("line \"" + d.name + "\" has both ends on one body; join two");
  }
  if (d.line.on_seabed && d.anchor.body != world_index) {
    throw ModelError("line \"" + d.name +
                     "\" lies on the bottom, but its anchor is on a body that moves; anchor it to "
                     "the world or let it hang free");
  }
}

MooringLine::Ends MooringLine::find_ends(const MotionState& state) const {
  const BodyPoint& a = definition_.anchor;
  const BodyPoint& f = definition_.fairlead;
  const Vector3 p_WA = point_position(state.kinematics, a.body, a.p_BoQ_B);
  const Vector3 reach = point_position(state.kinematics, f.body, f.p_BoQ_B) - p_WA;
  Ends ends;
  ends.span = std::hypot(reach.x(), reach.y());
  ends.rise = reach.z();
  ends.anchor_height = p_WA.z();
  // With one end above the other there is no direction, and no level force either.
  ends.level_W = ends.span > 1e-9 * definition_.line.unstretched_length
                     ? Vector3(reach.x() / ends.span, reach.y() / ends.span, 0.0)
                     : Vector3(Vector3::Zero());
  return ends;
}

Catenary MooringLine::calc_shape(const MotionState& state) const {
  const Ends ends = find_ends(state);
  return calc_catenary(definition_.line, ends.span, ends.rise);
}

void MooringLine::add_forces(const MotionState& state, Loads& loads) const {
  const Ends ends = find_ends(state);
  const Catenary c = calc_catenary(definition_.line, ends.span, ends.rise);
  const Vector3 level = c.horizontal * ends.level_W;
  const Vector3 up = Vector3::UnitZ();
  add_point_force(state.kinematics, definition_.anchor.body, definition_.anchor.p_BoQ_B,
                  level + c.lower_vertical * up, loads.F_Bo_W);
  add_point_force(state.kinematics, definition_.fairlead.body, definition_.fairlead.p_BoQ_B,
                  -level - c.vertical * up, loads.F_Bo_W);
}

void MooringLine::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Ends ends = find_ends(state);
  const Catenary c = calc_catenary(definition_.line, ends.span, ends.rise);
  const Vector3& e = ends.level_W;
  const Vector3 up = Vector3::UnitZ();
  Matrix3 K = c.stiffness(0, 0) * e * e.transpose() +
              c.stiffness(0, 1) * (e * up.transpose() + up * e.transpose()) +
              c.stiffness(1, 1) * up * up.transpose();
  if (ends.span > 0.0) {
    const Vector3 side = up.cross(e);
    K += c.horizontal / ends.span * side * side.transpose();
  }
  derivatives.locate(0, definition_.anchor.body, arm_W(state.kinematics, definition_.anchor));
  derivatives.locate(1, definition_.fairlead.body, arm_W(state.kinematics, definition_.fairlead));
  derivatives.add_held_force(0, c.horizontal * e + c.lower_vertical * up);
  derivatives.add_held_force(1, -c.horizontal * e - c.vertical * up);
  derivatives.add_line(0, 1, K, Matrix3::Zero());
}

EnergyAccount MooringLine::calc_energy(const MotionState& state) const {
  const Ends ends = find_ends(state);
  EnergyAccount account;
  account.stored_energy = calc_catenary(definition_.line, ends.span, ends.rise).energy;
  if (!definition_.line.on_seabed) {
    account.stored_energy += definition_.line.weight_per_length *
                             definition_.line.unstretched_length * ends.anchor_height;
  }
  return account;
}

TuggerLine::TuggerLine(Definition definition) : definition_(std::move(definition)) {
  const auto require = [&](const char* what, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw ModelError("tugger line \"" + definition_.name + "\" has the " + what + " " +
                     std::to_string(value) + "; a finite number, zero or more, is due");
  };
  require("stiffness", definition_.stiffness);
  require("damping", definition_.damping);
  require("unstretched length", definition_.unstretched_length);
  require("held tension", definition_.tension);
  if (definition_.tension > 0.0 && definition_.stiffness > 0.0) {
    throw ModelError("tugger line \"" + definition_.name +
                     "\" holds a tension and has a stiffness; one of the two is due");
  }
  if (definition_.from.body == definition_.to.body) {
    throw ModelError("tugger line \"" + definition_.name +
                     "\" has both ends on one body; join two");
  }
}

TuggerLoad TuggerLine::calc_elastic_and_damping(const Kinematics& kinematics) const {
  const BodyPoint& a = definition_.from;
  const BodyPoint& b = definition_.to;
  const Vector3 span =
      point_position(kinematics, b.body, b.p_BoQ_B) - point_position(kinematics, a.body, a.p_BoQ_B);
  TuggerLoad load;
  load.length = span.norm();
  if (!(load.length > 1e-12)) {
    throw ModelError("tugger line \"" + definition_.name +
                     "\": its ends coincide, so the direction of its pull is undefined");
  }
  load.direction_W = span / load.length;
  load.relative_velocity_W =
      point_velocity(kinematics, b.body, b.p_BoQ_B) - point_velocity(kinematics, a.body, a.p_BoQ_B);
  load.rate = load.direction_W.dot(load.relative_velocity_W);
  load.elastic_force = definition_.tension > 0.0
                           ? definition_.tension
                           : definition_.stiffness * (load.length - definition_.unstretched_length);
  load.damping_force = definition_.damping * load.rate;
  return load;
}

TuggerLoad TuggerLine::calc_load(const Kinematics& kinematics, bool acts) const {
  TuggerLoad load = calc_elastic_and_damping(kinematics);
  load.acts = acts;
  load.tension = one_sided_force(load.elastic_force, load.damping_force, acts);
  return load;
}

TuggerLoad TuggerLine::calc_load(const Kinematics& kinematics) const {
  TuggerLoad load = calc_elastic_and_damping(kinematics);
  load.acts = load.slack_indicator() > 0.0;
  load.tension = one_sided_force(load.elastic_force, load.damping_force, load.acts);
  return load;
}

void TuggerLine::add_forces(const Kinematics& kinematics, const TuggerLoad& load,
                            Loads& loads) const {
  if (!load.acts) return;
  const Vector3 f_W = load.tension * load.direction_W;
  add_point_force(kinematics, definition_.from.body, definition_.from.p_BoQ_B, f_W, loads.F_Bo_W);
  add_point_force(kinematics, definition_.to.body, definition_.to.p_BoQ_B, -f_W, loads.F_Bo_W);
}

void TuggerLine::add_derivatives(const Kinematics& kinematics, const TuggerLoad& load,
                                 ForceDerivatives& derivatives) const {
  if (!load.acts) return;
  derivatives.locate(0, definition_.from.body, arm_W(kinematics, definition_.from));
  derivatives.locate(1, definition_.to.body, arm_W(kinematics, definition_.to));
  derivatives.add_tension(0, 1, {load.direction_W, load.length, load.relative_velocity_W},
                          load.tension, definition_.stiffness, definition_.damping);
}

EnergyAccount TuggerLine::calc_energy(const TuggerLoad& load) const {
  if (!load.acts) return {};
  const double lost = load.damping_force * load.rate;
  if (definition_.tension > 0.0)
    return {.dissipated_power = lost, .supplied_power = -definition_.tension * load.rate};
  const double stretch = load.length - definition_.unstretched_length;
  return {.stored_energy = 0.5 * definition_.stiffness * stretch * stretch,
          .dissipated_power = lost};
}

}  // namespace blocklift::dynamics
