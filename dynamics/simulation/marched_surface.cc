#include "dynamics/simulation/marched_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/level_axes.h"

namespace blocklift::dynamics {
namespace {

const RadiatedWater& water_of(const LiftSystem& system, const DirectRadiation& radiation) {
  if (!system.water() || system.memory_count() != 0) {
    throw ModelError(
        "a surface is to be marched beside a system whose water is not made for it: give it the "
        "surface's added mass and no memory of its own");
  }
  const Eigen::Index size = radiation.infinite_added_mass().rows();
  if (system.water()->inertia().size() != size) {
    throw ModelError("the marched surface has " + std::to_string(size) + " modes, the system's " +
                     "water " + std::to_string(system.water()->inertia().size()));
  }
  return *system.water();
}

}  // namespace

MarchedSurface::MarchedSurface(DirectRadiation& radiation, double step, const LiftSystem& system,
                               LiftWorkspace& w)
    : radiation_(radiation), water_(water_of(system, radiation)), step_(step) {
  radiation_.start(step);
  compute_kinematics(system.mechanism(), w.q, w.v, w.kinematics);
  velocity_ = velocity_of(w);
  carry(w);
  past_.fill(force());
  w.marched.coefficients = Eigen::Matrix<double, Eigen::Dynamic, 4>::Zero(past_[0].size(), 4);
  w.marched.coefficients.col(0) = past_[0];
  w.marched.from = 0.0;
  w.marched.step = step_;
}

Eigen::VectorXd MarchedSurface::velocity_of(LiftWorkspace& w) const {
  water_.inertia().calc_velocity(w.kinematics, w.level_velocity);
  turn_to_level_axes(water_.frames(), w.kinematics, w.level_velocity);
  Eigen::VectorXd velocity(w.level_velocity.size());
  for (Eigen::Index mode = 0; mode < velocity.size(); ++mode) {
    velocity[mode] = w.level_velocity[place_of_mode(mode)];
  }
  return velocity;
}

void MarchedSurface::carry(const LiftWorkspace& w) {
  Eigen::Vector2d place = Eigen::Vector2d::Zero(), ahead = Eigen::Vector2d::Zero();
  for (const BodyFrame& frame : water_.frames()) {
    const Pose X_WH = w.kinematics.X_WB[frame.body] * frame.X_BH;
    place += X_WH.p.head<2>() / static_cast<double>(water_.frames().size());
    ahead += X_WH.R.col(0).head<2>();
  }
  radiation_.carry(place, std::atan2(ahead.y(), ahead.x()));
}

Eigen::VectorXd MarchedSurface::force() const {
  const Eigen::VectorXd by_modes = radiation_.calc_force();
  Eigen::VectorXd force(by_modes.size());
  for (Eigen::Index mode = 0; mode < force.size(); ++mode) {
    force[place_of_mode(mode)] = by_modes[mode];
  }
  return force;
}

void MarchedSurface::advance(LiftWorkspace& w) {
  const Eigen::VectorXd before = velocity_;
  velocity_ = velocity_of(w);
  carry(w);
  radiation_.advance(0.5 * (before + velocity_));
  ++steps_;
  std::rotate(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = force();
  prepare_force(w);
}

void MarchedSurface::prepare_force(LiftWorkspace& w) const {
  auto& c = w.marched.coefficients;
  // Hermite's cubic, slopes by the step.
  const Eigen::VectorXd value = c.rowwise().sum();
  const Eigen::VectorXd slope = c.col(1) + 2.0 * c.col(2) + 3.0 * c.col(3);
  const Eigen::VectorXd end_value = 3.0 * (past_[0] - past_[1]) + past_[2];
  const Eigen::VectorXd end_slope = 2.5 * past_[0] - 4.0 * past_[1] + 1.5 * past_[2];
  c.col(0) = value;
  c.col(1) = slope;
  c.col(2) = 3.0 * (end_value - value) - 2.0 * slope - end_slope;
  c.col(3) = 2.0 * (value - end_value) + slope + end_slope;
  w.marched.from = static_cast<double>(steps_) * step_;
}

double marching_step(const DirectRadiation& radiation, double highest) {
  return std::min(0.9 * radiation.step_limit(), 2.0 * std::numbers::pi / (25.0 * highest));
}

}  // namespace blocklift::dynamics
