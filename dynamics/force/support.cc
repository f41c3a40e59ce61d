#include "dynamics/force/support.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

SupportPad::SupportPad(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  if (!(d.stiffness > 0.0) || !std::isfinite(d.stiffness)) {
    throw ModelError("support \"" + d.name + "\" has the stiffness " + std::to_string(d.stiffness) +
                     "; a number above zero is due");
  }
  for (const double value :
       {d.damping, d.friction_coefficient, d.tangential_stiffness, d.tangential_damping}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw ModelError("support \"" + d.name +
                       "\": damping, friction coefficient and tangential stiffness and damping "
                       "must be finite and not negative");
    }
  }
  if (d.ground && !(d.tangential_stiffness > 0.0)) {
    throw ModelError("support \"" + d.name +
                     "\" is ground: its tangential stiffness must be above zero");
  }
  if (!(d.reach > 0.0)) {
    throw ModelError("support \"" + d.name + "\" reaches " + std::to_string(d.reach) +
                     " m; a length above zero is due");
  }
  if (!d.p_WG.allFinite()) {
    throw ModelError("support \"" + d.name + "\" needs the place on the ground where it stands");
  }
}

SupportLoad SupportPad::calc_depth(const Kinematics& kinematics, const Vector3& p_WG) const {
  const BodyPoint& point = definition_.point;
  SupportLoad load;
  load.p_WG = p_WG;
  const Vector3 s = point_position(kinematics, point.body, point.p_BoQ_B) - p_WG;
  load.depth = std::min(-s.z(), definition_.reach - s.head<2>().norm());
  load.depth_rate = -point_velocity(kinematics, point.body, point.p_BoQ_B).z();
  load.elastic_force = definition_.stiffness * load.depth;
  load.damping_force = definition_.damping * load.depth_rate;
  return load;
}

void SupportPad::set_force(const Kinematics& kinematics, SupportLoad& load) const {
  const BodyPoint& point = definition_.point;
  const Vector3 s = point_position(kinematics, point.body, point.p_BoQ_B) - load.p_WG;
  const Vector3 rate = point_velocity(kinematics, point.body, point.p_BoQ_B);
  Vector3 f = -(definition_.tangential_stiffness * s + definition_.tangential_damping * rate);
  f.z() = 0.0;
  const double most = definition_.friction_coefficient * std::max(0.0, load.normal_force);
  const double length = f.norm();
  if (length > most) f *= most / length;
  load.force_W = f + Vector3(0.0, 0.0, load.normal_force);
}

SupportLoad SupportPad::calc_load(const Kinematics& kinematics, const Vector3& p_WG) const {
  SupportLoad load = calc_depth(kinematics, p_WG);
  load.carries = load.indicator() > 0.0;
  load.normal_force = one_sided_force(load.elastic_force, load.damping_force, load.carries);
  set_force(kinematics, load);
  return load;
}

SupportLoad SupportPad::calc_load(const Kinematics& kinematics, bool carries,
                                  const Vector3& p_WG) const {
  SupportLoad load = calc_depth(kinematics, p_WG);
  load.carries = carries;
  load.normal_force = one_sided_force(load.elastic_force, load.damping_force, carries);
  set_force(kinematics, load);
  return load;
}

void SupportPad::add_force(const Kinematics& kinematics, const SupportLoad& load,
                           Loads& loads) const {
  add_point_force(kinematics, definition_.point.body, definition_.point.p_BoQ_B, load.force_W,
                  loads.F_Bo_W);
}

void SupportPad::add_derivatives(const Kinematics& kinematics, const SupportLoad& load,
                                 ForceDerivatives& derivatives) const {
  if (!load.carries) return;
  const BodyPoint& point = definition_.point;
  Matrix3 K = Matrix3::Zero();
  Matrix3 C = Matrix3::Zero();
  K(2, 2) = -definition_.stiffness;
  C(2, 2) = -definition_.damping;
  const Vector3 s = point_position(kinematics, point.body, point.p_BoQ_B) - load.p_WG;
  const Vector3 rate = point_velocity(kinematics, point.body, point.p_BoQ_B);
  const Eigen::Vector2d f =
      -(definition_.tangential_stiffness * s + definition_.tangential_damping * rate).head<2>();
  const double most = definition_.friction_coefficient * std::max(0.0, load.normal_force);
  const double length = f.norm();
  // Sticking: df = -k_t ds - c_t dv. Sliding: f = mu N f/|f|, whose length follows N and whose
  // direction follows the force that would stick.
  Eigen::Matrix2d slope = Eigen::Matrix2d::Identity();
  if (length > most) {
    const Eigen::Vector2d along = f / length;
    slope = most / length * (Eigen::Matrix2d::Identity() - along * along.transpose());
    if (most > 0.0) {
      K.topRightCorner<2, 1>() = definition_.friction_coefficient * K(2, 2) * along;
      C.topRightCorner<2, 1>() = definition_.friction_coefficient * C(2, 2) * along;
    }
  }
  K.topLeftCorner<2, 2>() = -definition_.tangential_stiffness * slope;
  C.topLeftCorner<2, 2>() = -definition_.tangential_damping * slope;
  derivatives.locate(0, point.body, arm_W(kinematics, point));
  derivatives.add_block(0, 0, K, C);
  derivatives.add_held_force(0, load.force_W);
}

EnergyAccount SupportPad::calc_energy(const Kinematics& kinematics, const SupportLoad& load) const {
  const double elastic = load.carries ? load.elastic_force : std::max(0.0, load.elastic_force);
  const Vector3 rate =
      point_velocity(kinematics, definition_.point.body, definition_.point.p_BoQ_B);
  const double friction_power = load.force_W.x() * rate.x() + load.force_W.y() * rate.y();
  const double damped = load.carries ? load.damping_force * load.depth_rate
                                     : -elastic * std::min(0.0, load.depth_rate);
  return {.stored_energy = 0.5 * elastic * elastic / definition_.stiffness,
          .dissipated_power = damped - friction_power};
}

}  // namespace blocklift::dynamics
