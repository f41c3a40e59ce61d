#include "dynamics/marine/radiation/retardation_from_damping.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

/// int of cos(w t) dw and of (w - a) cos(w t) dw, each from a to b.
struct CosineIntegrals {
  double constant, linear;

  CosineIntegrals(double a, double b, double t) {
    const double h = b - a;
    // (1 - cos(h t))/t^2 and sin(h t)/t by the half angle: exact for small t, too.
    const double half = 0.5 * h * t;
    const double sinc = std::abs(half) < 1e-8 ? 1.0 : std::sin(half) / half;
    const double mean = std::cos(0.5 * (a + b) * t);
    constant = h * sinc * mean;
    if (std::abs(half) < 1e-3) {
      linear = 0.5 * h * h * (std::cos(a * t) - h * t * std::sin(a * t) * 2.0 / 3.0);
    } else {
      linear = h * std::sin(b * t) / t + (std::cos(b * t) - std::cos(a * t)) / (t * t);
    }
  }
};

}  // namespace

void add_retardation(HydrodynamicDatabase& database) {
  const std::vector<double>& w = database.frequencies;
  if (w.size() < 3) {
    throw ModelError("retardation functions cannot follow from the damping at " +
                     std::to_string(w.size()) + " frequencies: at least three are needed");
  }
  double gap = w.front();
  for (std::size_t k = 1; k < w.size(); ++k) gap = std::max(gap, w[k] - w[k - 1]);
  database.time_step = 0.25 / w.back();
  const auto count =
      static_cast<std::size_t>(std::ceil(std::numbers::pi / (gap * database.time_step))) + 1;
  const Eigen::Index modes = database.mode_count();
  database.retardation.assign(count, Eigen::MatrixXd::Zero(modes, modes));
  for (std::size_t n = 0; n < count; ++n) {
    const double t = database.time_step * static_cast<double>(n);
    Eigen::MatrixXd& K = database.retardation[n];
    for (std::size_t k = 0; k < w.size(); ++k) {
      const double from = k == 0 ? 0.0 : w[k - 1];
      const CosineIntegrals integral(from, w[k], t);
      const double end = integral.linear / (w[k] - from);
      K += end * database.damping[k];
      if (k > 0) K += (integral.constant - end) * database.damping[k - 1];
    }
    K *= 2.0 / std::numbers::pi;
  }
}

void add_infinite_added_mass(HydrodynamicDatabase& database) {
  const Eigen::Index modes = database.mode_count();
  database.infinite_added_mass = Eigen::MatrixXd::Zero(modes, modes);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(modes, modes), mass, damping;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    calc_added_mass_and_damping(database, database.frequencies[k], mass, damping);
    sum += database.added_mass[k] - mass;
  }
  database.infinite_added_mass = sum / static_cast<double>(database.frequencies.size());
}

}  // namespace blocklift::dynamics
