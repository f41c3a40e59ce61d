#include "dynamics/marine/loads/linear_buoyancy.h"

#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Roll, pitch by the vertical: dy/du.
Matrix3 tilt_by_vertical() {
  Matrix3 tilt;
  tilt << 0, 0, 0, 0, 1, 0, -1, 0, 0;
  return tilt;
}

}  // namespace

LinearBuoyancy::LinearBuoyancy(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  const std::string start = "linear buoyancy \"" + d.name + "\"";
  if (d.frame.body <= world_index) throw ModelError(start + " bears no body that moves");
  if (!d.frame.X_BH.p.allFinite() || !d.frame.X_BH.R.allFinite() || !std::isfinite(d.rest_height) ||
      !std::isfinite(d.buoyancy) || !d.centre.allFinite() || !d.stiffness.allFinite()) {
    throw ModelError(start + " has a value that is not finite");
  }
  if (d.buoyancy < 0.0) throw ModelError(start + " is negative");
  const double asymmetry = (d.stiffness - d.stiffness.transpose()).lpNorm<Eigen::Infinity>();
  if (asymmetry > 1e-9 * d.stiffness.lpNorm<Eigen::Infinity>()) {
    throw ModelError(start + " has a stiffness that is not symmetric");
  }
}

LinearBuoyancy::Shift LinearBuoyancy::calc_shift(const MotionState& state) const {
  const Definition& d = definition_;
  const Pose& X_WB = state.kinematics.X_WB[d.frame.body];
  Shift shifted;
  shifted.p_BoR_W = X_WB.R * d.frame.X_BH.p;
  shifted.R_WH = X_WB.R * d.frame.X_BH.R;
  shifted.u = shifted.R_WH.row(2);
  shifted.y << X_WB.p.z() + shifted.p_BoR_W.z() - d.rest_height, shifted.u.y(), -shifted.u.x();
  const Vector3 pull = d.stiffness * shifted.y;
  shifted.lift = d.buoyancy - pull[0];
  shifted.gradient << -d.buoyancy * d.centre.x() - pull[2], -d.buoyancy * d.centre.y() + pull[1],
      0.0;
  return shifted;
}

void LinearBuoyancy::add_forces(const MotionState& state, Loads& loads) const {
  const Shift shifted = calc_shift(state);
  const Vector3 moment = shifted.R_WH * shifted.u.cross(shifted.gradient);
  loads.F_Bo_W[definition_.frame.body] +=
      shift_to(ForceVector{moment, {0.0, 0.0, shifted.lift}}, shifted.p_BoR_W);
}

void LinearBuoyancy::add_derivatives(const MotionState& state,
                                     ForceDerivatives& derivatives) const {
  const Shift shifted = calc_shift(state);
  // By (turn in H; rise): a turn changes u by u x turn.
  Eigen::Matrix<double, 3, 4> y_by = Eigen::Matrix<double, 3, 4>::Zero();
  y_by.leftCols<3>() = tilt_by_vertical() * skew(shifted.u);
  y_by(0, 3) = 1.0;
  const Eigen::Matrix<double, 3, 4> pull_by = definition_.stiffness * y_by;
  Eigen::Matrix<double, 3, 4> moment_by =
      skew(shifted.u) * tilt_by_vertical().transpose() * pull_by;
  moment_by.leftCols<3>() -= skew(shifted.gradient) * skew(shifted.u);

  const Matrix3& R = shifted.R_WH;
  const Vector3 moment = R * shifted.u.cross(shifted.gradient);
  Matrix6 by_motion = Matrix6::Zero();
  by_motion.topLeftCorner<3, 3>() = R * moment_by.leftCols<3>() * R.transpose() - skew(moment);
  by_motion.block<3, 1>(0, 5) = R * moment_by.col(3);
  by_motion.block<1, 3>(5, 0) = -pull_by.row(0).head<3>() * R.transpose();
  by_motion(5, 5) = -pull_by(0, 3);
  derivatives.locate(0, definition_.frame.body, shifted.p_BoR_W);
  derivatives.add_held_force(0, {0.0, 0.0, shifted.lift});
  derivatives.add_wrench_block(0, 0, by_motion, Matrix6::Zero());
}

EnergyAccount LinearBuoyancy::calc_energy(const MotionState& state) const {
  const Definition& d = definition_;
  const Shift shifted = calc_shift(state);
  const double height = shifted.y[0] + d.centre.dot(shifted.u.head<2>());
  return {.stored_energy = 0.5 * shifted.y.dot(d.stiffness * shifted.y) - d.buoyancy * height};
}

Matrix3 calc_stiffness_of_weight(double weight, const Vector3& arm) {
  return Eigen::Vector3d(0.0, -weight * arm.z(), -weight * arm.z()).asDiagonal();
}

}  // namespace blocklift::dynamics
