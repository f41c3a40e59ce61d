#include "dynamics/force/flow_coefficients.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

constexpr double pi = std::numbers::pi;

void require_coefficients(const std::string& who, const FlowCoefficients::Definition& d) {
  const auto require = [&](const char* what, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw ModelError(who + " has the " + what + " " + std::to_string(value) +
                     "; a finite number, zero or more, is due");
  };
  require("frontal area", d.frontal_area);
  require("lateral area", d.lateral_area);
  require("height", d.height);
  require("length", d.length);
  if (d.table.size() < 2) {
    throw ModelError(who + " has coefficients for " + std::to_string(d.table.size()) +
                     " headings; two or more are due");
  }
  for (std::size_t i = 0; i < d.table.size(); ++i) {
    const FlowCoefficients::Row& c = d.table[i];
    const bool finite = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.k) &&
                        std::isfinite(c.m) && std::isfinite(c.n) && std::isfinite(c.heading);
    if (!finite || (i > 0 && c.heading <= d.table[i - 1].heading)) {
      throw ModelError(who + ": entry " + std::to_string(i) +
                       " of its coefficients has the heading " + std::to_string(c.heading) +
                       " rad; finite numbers with ascending headings are due");
    }
  }
  if (d.table.back().heading - d.table.front().heading > 2.0 * pi + 1e-9) {
    throw ModelError(who + " has headings over more than a whole circle");
  }
}

}  // namespace

FlowCoefficients::FlowCoefficients(const std::string& who, const Definition& d) {
  require_coefficients(who, d);
  const auto add = [&](const Row& c, double side) {
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
  for (const Row& c : d.table) add(c, 1.0);
  // Joins the circle; a table that states its first heading again at the end is whole already.
  if (heading_.back() - heading_.front() < 2.0 * pi - 1e-9) {
    heading_.push_back(heading_.front() + 2.0 * pi);
    at_q_.push_back(at_q_.front());
  }
}

FlowCoefficients::Load FlowCoefficients::calc_load(double density, const Vector3& u_B) const {
  double beta = std::atan2(u_B.y(), u_B.x());
  while (beta < heading_.front()) beta += 2.0 * pi;
  while (beta > heading_.back()) beta -= 2.0 * pi;
  const auto next = std::upper_bound(heading_.begin() + 1, heading_.end() - 1, beta);
  const auto i = static_cast<std::size_t>(next - heading_.begin());
  const Vector6 slope = (at_q_[i] - at_q_[i - 1]) / (heading_[i] - heading_[i - 1]);
  const Vector6 at_q = at_q_[i - 1] + (beta - heading_[i - 1]) * slope;
  Load load;
  load.F_B = 0.5 * density * u_B.head<2>().squaredNorm() * at_q;
  // F_B = rho/2 |u|^2 c(beta):  dF_B/du = rho/2 (2 c u^T + c' (-u_y, u_x)).
  load.by_u.setZero();
  load.by_u.leftCols<2>() = density * at_q * u_B.head<2>().transpose();
  load.by_u.leftCols<2>() += 0.5 * density * slope * Eigen::RowVector2d(-u_B.y(), u_B.x());
  return load;
}

FlowLoad::FlowLoad(const FlowCoefficients::Load& load, const Matrix3& R_WB, const Vector3& u_W)
    : F_W{R_WB * load.F_B.head<3>(), R_WB * load.F_B.tail<3>()},
      dF_dX(Eigen::Matrix<double, 6, 6>::Zero()),
      dF_dV(Eigen::Matrix<double, 6, 6>::Zero()) {
  Eigen::Matrix<double, 6, 3> in_W;
  in_W << R_WB * load.by_u.topRows<3>() * R_WB.transpose(),
      R_WB * load.by_u.bottomRows<3>() * R_WB.transpose();
  dF_dX.leftCols<3>() << -skew(F_W.moment), -skew(F_W.force);
  dF_dX.leftCols<3>() += in_W * skew(u_W);
  dF_dV.rightCols<3>() = -in_W;
}

}  // namespace blocklift::dynamics
