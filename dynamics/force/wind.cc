#include "dynamics/force/wind.h"

#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

Wind Wind::level(double speed, double heading, double air_density) {
  return {speed * Vector3(std::cos(heading), std::sin(heading), 0.0), air_density};
}

WindArea::WindArea(const Wind& wind, Definition definition)
    : WindArea(wind, nullptr, std::move(definition)) {}

namespace {

Wind density_of(const WindField* field, const std::string& name) {
  if (!field) throw ModelError("wind area \"" + name + "\" needs a wind");
  return {Vector3::Zero(), field->air_density()};
}

}  // namespace

WindArea::WindArea(const std::shared_ptr<const WindField>& wind, const Definition& definition)
    : WindArea(density_of(wind.get(), definition.name), wind, definition) {}

WindArea::WindArea(const Wind& wind, std::shared_ptr<const WindField> field, Definition definition)
    : definition_(std::move(definition)),
      velocity_W_(wind.velocity_W),
      field_(std::move(field)),
      half_density_area_(0.5 * wind.air_density * definition_.coefficient * definition_.area) {
  const auto require = [&](const char* what, double value) {
    if (!std::isfinite(value) || value < 0.0) {
      throw ModelError("wind area \"" + definition_.name + "\" has the " + what + " " +
                       std::to_string(value) + "; a finite number, zero or more, is due");
    }
  };
  require("area", definition_.area);
  require("coefficient", definition_.coefficient);
  require("air density", wind.air_density);
  require("wind speed", wind.velocity_W.norm());
  if (definition_.normal_B) {
    const double length = definition_.normal_B->norm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw ModelError("wind area \"" + definition_.name + "\" has a normal without length");
    }
    *definition_.normal_B /= length;
  }
}

Vector3 WindArea::calc_relative_velocity(const MotionState& state) const {
  const BodyPoint& centre = definition_.centre_of_pressure;
  const Vector3 own = point_velocity(state.kinematics, centre.body, centre.p_BoQ_B);
  if (!field_) return velocity_W_ - own;
  const double z = point_position(state.kinematics, centre.body, centre.p_BoQ_B).z();
  return field_->calc_velocity(state.time, z) - own;
}

Vector3 WindArea::calc_force(const MotionState& state) const {
  const BodyPoint& centre = definition_.centre_of_pressure;
  const Vector3 u = calc_relative_velocity(state);
  if (!definition_.normal_B) return half_density_area_ * u.norm() * u;
  const Vector3 n = state.kinematics.X_WB[centre.body].R * *definition_.normal_B;
  const double normal_speed = u.dot(n);
  return half_density_area_ * std::abs(normal_speed) * normal_speed * n;
}

void WindArea::add_forces(const MotionState& state, Loads& loads) const {
  const BodyPoint& centre = definition_.centre_of_pressure;
  add_point_force(state.kinematics, centre.body, centre.p_BoQ_B, calc_force(state), loads.F_Bo_W);
}

void WindArea::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const BodyPoint& centre = definition_.centre_of_pressure;
  const Vector3 u = calc_relative_velocity(state);
  const Matrix3 none = Matrix3::Zero();
  derivatives.locate(0, centre.body, arm_W(state.kinematics, centre));
  derivatives.add_held_force(0, calc_force(state));
  if (!definition_.normal_B) {
    const double speed = u.norm();
    if (speed == 0.0) return;
    const Matrix3 by_u =
        half_density_area_ * (speed * Matrix3::Identity() + u * u.transpose() / speed);
    derivatives.add_block(0, 0, none, -by_u);
    return;
  }
  // f = a |s| s n, s = u.n:  df = 2 a |s| n ds + a |s| s dtheta x n,  ds = -n.dv + (n x u).dtheta.
  const Vector3 n = state.kinematics.X_WB[centre.body].R * *definition_.normal_B;
  const double s = u.dot(n);
  const double slope = 2.0 * half_density_area_ * std::abs(s);
  derivatives.add_block(0, 0, none, -slope * n * n.transpose());
  derivatives.add_turning(0, slope * n * n.cross(u).transpose() - 0.5 * slope * s * skew(n));
}

EnergyAccount WindArea::calc_energy(const MotionState& state) const {
  const BodyPoint& centre = definition_.centre_of_pressure;
  return {.supplied_power =
              calc_force(state).dot(point_velocity(state.kinematics, centre.body, centre.p_BoQ_B))};
}

}  // namespace blocklift::dynamics
