#include "dynamics/marine/green/damping_beyond.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double slowest_rise = 1.0, fastest_rise = 12.0;
constexpr double slowest_fall = 2.5, fastest_fall = 12.0;
/// Of the band's highest frequency, where the tail ends; and what its added mass is compared below.
constexpr double farthest = 40.0, compared = 0.8;

/// The nearest positive semidefinite matrix, entries being measured by `scales` of the modes.
MatrixXd without_negative(const MatrixXd& matrix, const VectorXd& scales) {
  MatrixXd vectors =
      scales.cwiseInverse().asDiagonal() * matrix * scales.cwiseInverse().asDiagonal();
  const VectorXd values = decompose_symmetric(vectors);
  if (values.size() == 0 || values[0] >= 0.0) return matrix;
  const MatrixXd kept = vectors * values.cwiseMax(0.0).asDiagonal() * vectors.transpose();
  return scales.asDiagonal() * kept * scales.asDiagonal();
}

VectorXd powers(double base, const VectorXd& exponents) {
  return exponents.unaryExpr([base](double p) { return std::pow(base, p); });
}

/// int from 1 of x^-p/(x^2 - r^2) dx and of h(x)/(x^2 - r^2) dx, for r < 1.
struct TailIntegrals {
  double fall = 0.0, hump = 0.0;

  TailIntegrals(double p, double r) {
    double factor = 1.0;
    for (int n = 0; factor > 1e-12; ++n, factor *= r * r) {
      fall += factor / (p + 1.0 + 2 * n);
      hump += factor * (1.0 / (5.0 + 2 * n) - 2.0 / (6.0 + 2 * n) + 1.0 / (7.0 + 2 * n));
    }
  }
};

/// Slope of ln b over ln w from one sample to the other, within bounds.
double slope_between(double w_1, double b_1, double w_2, double b_2, double low, double high) {
  if (!(b_1 > 0.0) || !(b_2 > 0.0)) return high;
  return std::clamp(std::log(b_2 / b_1) / std::log(w_2 / w_1), low, high);
}

}  // namespace

DampingBeyond::DampingBeyond(std::vector<double> frequencies, std::vector<MatrixXd> damping,
                             const std::vector<double>& at, const MatrixXd& added_mass)
    : frequencies_(std::move(frequencies)), damping_(std::move(damping)) {
  if (frequencies_.size() < 3 || damping_.size() != frequencies_.size() ||
      added_mass.rows() != damping_[0].rows() ||
      added_mass.cols() != static_cast<Eigen::Index>(at.size())) {
    throw ModelError("damping cannot be continued from " + std::to_string(damping_.size()) +
                     " samples at " + std::to_string(frequencies_.size()) +
                     " frequencies: at least three are needed, and the added mass of each mode");
  }
  VectorXd peaks = VectorXd::Zero(damping_[0].rows());
  for (const MatrixXd& B : damping_) peaks = peaks.cwiseMax(B.diagonal());
  const VectorXd scales =
      peaks.cwiseMax(std::max(1e-12 * peaks.maxCoeff(), std::numeric_limits<double>::min()))
          .cwiseSqrt();
  for (MatrixXd& B : damping_) B = without_negative(B, scales);
  add_below();
  find_tail(at, added_mass);
  add_above();
}

void DampingBeyond::add_below() {
  constexpr int count = 60;
  const double lowest = frequencies_[0];
  const MatrixXd &first = damping_[0], &second = damping_[1];
  rises_.resize(first.rows());
  for (Eigen::Index m = 0; m < rises_.size(); ++m) {
    rises_[m] = slope_between(lowest, first(m, m), frequencies_[1], second(m, m), slowest_rise,
                              fastest_rise);
  }
  std::vector<double> below;
  std::vector<MatrixXd> damping;
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / count;
    const VectorXd R = powers(share, 0.5 * rises_);
    below.push_back(share * lowest);
    damping.emplace_back(R.asDiagonal() * first * R.asDiagonal());
  }
  frequencies_.insert(frequencies_.begin(), below.begin(), below.end());
  damping_.insert(damping_.begin(), damping.begin(), damping.end());
}

// By least squares over the frequencies, each mode by itself: c for the p of the slope, or, if that
// is negative, the p that fits best without.
void DampingBeyond::find_tail(const std::vector<double>& at, const MatrixXd& added_mass) {
  const double highest = frequencies_.back();
  const std::size_t last = frequencies_.size() - 1;
  const MatrixXd &end = damping_[last], &before = damping_[last - 1];
  falls_.resize(end.rows());
  humps_ = VectorXd::Zero(end.rows());
  std::vector<double> within;
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k] > compared * highest) continue;
    within.push_back(at[k]);
    columns.push_back(static_cast<Eigen::Index>(k));
  }
  std::vector<MatrixXd> known;
  if (!within.empty()) known = integrate_added_mass(frequencies_, damping_, within);
  for (Eigen::Index m = 0; m < falls_.size(); ++m) {
    falls_[m] = -slope_between(frequencies_[last - 1], before(m, m), highest, end(m, m),
                               -fastest_fall, -slowest_fall);
    if (within.empty()) continue;
    VectorXd missing(static_cast<Eigen::Index>(within.size()));
    for (Eigen::Index k = 0; k < missing.size(); ++k) {
      missing[k] = added_mass(m, columns[k]) - known[k](m, m);
    }
    missing *= 0.5 * std::numbers::pi * highest;
    const auto tail = [&](double p, VectorXd& fall, VectorXd& hump) {
      fall.resize(missing.size());
      hump.resize(missing.size());
      for (Eigen::Index k = 0; k < missing.size(); ++k) {
        const TailIntegrals integrals(p, within[k] / highest);
        fall[k] = integrals.fall * end(m, m);
        hump[k] = integrals.hump;
      }
    };
    VectorXd fall, hump;
    tail(falls_[m], fall, hump);
    humps_[m] = hump.dot(missing - fall) / hump.squaredNorm();
    if (humps_[m] >= 0.0) continue;
    humps_[m] = 0.0;
    double least = (missing - fall).squaredNorm();
    for (double p = falls_[m]; p <= fastest_fall; p += 0.1) {
      tail(p, fall, hump);
      const double misfit = (missing - fall).squaredNorm();
      if (misfit >= least) continue;
      least = misfit;
      falls_[m] = p;
    }
  }
}

void DampingBeyond::add_above() {
  constexpr double ratio = 1.01;
  const double highest = frequencies_.back();
  const MatrixXd end = damping_.back();
  for (double x = ratio; x < farthest; x *= ratio) {
    const VectorXd S = powers(1.0 / x, 0.5 * falls_);
    MatrixXd B = S.asDiagonal() * end * S.asDiagonal();
    B.diagonal() += (x - 1.0) * (x - 1.0) / std::pow(x, 6) * humps_;
    frequencies_.push_back(x * highest);
    damping_.push_back(std::move(B));
  }
}

}  // namespace blocklift::dynamics
