#include "dynamics/force/wind_load.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

constexpr double pi = std::numbers::pi;

void require_load(const WindLoad::Definition& d) {
  const auto require = [&](const char* what, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw ModelError("wind load \"" + d.name + "\" has the " + what + " " + std::to_string(value) +
                     "; a finite number, zero or more, is due");
  };
  require("frontal area", d.frontal_area);
  require("lateral area", d.lateral_area);
  require("height", d.height);
  require("length", d.length);
  if (!d.wind) throw ModelError("wind load \"" + d.name + "\" needs a wind");
  if (d.reference.body <= world_index) {
    throw ModelError("wind load \"" + d.name + "\" acts on no body that moves");
  }
  if (d.table.size() < 2) {
    throw ModelError("wind load \"" + d.name + "\" has coefficients for " +
                     std::to_string(d.table.size()) + " headings; two or more are due");
  }
  for (std::size_t i = 0; i < d.table.size(); ++i) {
    const WindLoad::Coefficients& c = d.table[i];
    const bool finite = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.k) &&
                        std::isfinite(c.m) && std::isfinite(c.n) && std::isfinite(c.heading);
    if (!finite || (i > 0 && c.heading <= d.table[i - 1].heading)) {
      throw ModelError("wind load \"" + d.name + "\": entry " + std::to_string(i) +
                       " of its coefficients has the heading " + std::to_string(c.heading) +
                       " rad; finite numbers with ascending headings are due");
    }
  }
  if (d.table.back().heading - d.table.front().heading > 2.0 * pi + 1e-9) {
    throw ModelError("wind load \"" + d.name + "\" has headings over more than a whole circle");
  }
}

}  // namespace

WindLoad::WindLoad(Definition definition) : definition_(std::move(definition)) {
  const Definition& d = definition_;
  require_load(d);
  const auto add = [&](const Coefficients& c, double side) {
    Vector6 at_q;
    at_q << d.lateral_area * d.height * c.k * side, d.frontal_area * d.height * c.m,
        d.lateral_area * d.length * c.n * side, d.frontal_area * c.x, d.lateral_area * c.y * side,
        0.0;
    heading_.push_back(side * c.heading);
    at_q_.push_back(at_q);
  };
  const bool half =
      std::abs(d.table.front().heading) < 1e-9 && std::abs(d.table.back().heading - pi) < 1e-9;
  if (half) {
    for (std::size_t i = d.table.size(); i-- > 1;) add(d.table[i], -1.0);
  }
  for (const Coefficients& c : d.table) add(c, 1.0);
  // Joins the circle; a table that states its first heading again at the end is whole already.
  if (heading_.back() - heading_.front() < 2.0 * pi - 1e-9) {
    heading_.push_back(heading_.front() + 2.0 * pi);
    at_q_.push_back(at_q_.front());
  }
}

WindLoad::Air WindLoad::find_air(const MotionState& state) const {
  const BodyPoint& P = definition_.reference;
  const Pose& X_WB = state.kinematics.X_WB[static_cast<std::size_t>(P.body)];
  Air air;
  air.r_W = X_WB.R * P.p_BoQ_B;
  const double z = X_WB.p.z() + air.r_W.z();
  air.u_W = definition_.wind->calc_velocity(state.time, z) -
            point_velocity(state.kinematics, P.body, P.p_BoQ_B);
  air.u_B = X_WB.R.transpose() * air.u_W;
  double beta = std::atan2(air.u_B.y(), air.u_B.x());
  while (beta < heading_.front()) beta += 2.0 * pi;
  while (beta > heading_.back()) beta -= 2.0 * pi;
  const auto next = std::upper_bound(heading_.begin() + 1, heading_.end() - 1, beta);
  const auto i = static_cast<std::size_t>(next - heading_.begin());
  air.slope = (at_q_[i] - at_q_[i - 1]) / (heading_[i] - heading_[i - 1]);
  air.at_q = at_q_[i - 1] + (beta - heading_[i - 1]) * air.slope;
  return air;
}

ForceVector WindLoad::calc_force(const MotionState& state) const {
  const Air air = find_air(state);
  const Matrix3& R = state.kinematics.X_WB[static_cast<std::size_t>(definition_.reference.body)].R;
  const double q = 0.5 * definition_.wind->air_density() * air.u_B.head<2>().squaredNorm();
  return {R * (q * air.at_q.head<3>()), R * (q * air.at_q.tail<3>())};
}

void WindLoad::add_forces(const MotionState& state, Loads& loads) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  loads.F_Bo_W[body] += shift_to(calc_force(state), r_W);
}

void WindLoad::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Air air = find_air(state);
  const ForceVector F = calc_force(state);
  const Matrix3& R = state.kinematics.X_WB[static_cast<std::size_t>(definition_.reference.body)].R;
  // F_B = rho/2 |u|^2 c(beta):  dF_B/du = rho/2 (2 c u^T + c' (-u_y, u_x)).
  Eigen::Matrix<double, 6, 3> by_u = Eigen::Matrix<double, 6, 3>::Zero();
  by_u.leftCols<2>() = definition_.wind->air_density() * air.at_q * air.u_B.head<2>().transpose();
  by_u.leftCols<2>() += 0.5 * definition_.wind->air_density() * air.slope *
                        Eigen::RowVector2d(-air.u_B.y(), air.u_B.x());
  Eigen::Matrix<double, 6, 3> in_W;
  in_W << R * by_u.topRows<3>() * R.transpose(), R * by_u.bottomRows<3>() * R.transpose();
  Eigen::Matrix<double, 6, 6> dF_dX = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> dF_dV = Eigen::Matrix<double, 6, 6>::Zero();
  dF_dX.leftCols<3>() << -skew(F.moment), -skew(F.force);
  dF_dX.leftCols<3>() += in_W * skew(air.u_W);
  dF_dV.rightCols<3>() = -in_W;
  derivatives.locate(0, definition_.reference.body, air.r_W);
  derivatives.add_held_force(0, F.force);
  derivatives.add_wrench_block(0, 0, dF_dX, dF_dV);
}

EnergyAccount WindLoad::calc_energy(const MotionState& state) const {
  const auto body = static_cast<std::size_t>(definition_.reference.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.reference.p_BoQ_B;
  return {.supplied_power = dot(shift_to(calc_force(state), r_W), state.kinematics.V_WB[body])};
}

}  // namespace blocklift::dynamics
