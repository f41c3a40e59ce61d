#include "dynamics/marine/green/patched_polynomials.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace blocklift::dynamics {
namespace {

constexpr int n = Patches::points_in_each;
using Square = Eigen::Matrix<double, n, n>;

double chebyshev_point(int i) { return -std::cos(std::numbers::pi * (i + 0.5) / n); }

/// Turns values at the Chebyshev points into coefficients of powers.
Square powers_from_values() {
  Square powers;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) powers(i, j) = std::pow(chebyshev_point(i), j);
  }
  return powers.inverse();
}

}  // namespace

std::vector<double> Patches::points() const {
  std::vector<double> result;
  for (int patch = 0; patch < count; ++patch) {
    for (int i = 0; i < n; ++i) {
      result.push_back(from + width() * (patch + 0.5 * (1.0 + chebyshev_point(i))));
    }
  }
  return result;
}

PatchedCurve::PatchedCurve(const Patches& patches, const std::function<double(double)>& function)
    : patches_(patches) {
  const Square turn = powers_from_values();
  const std::vector<double> points = patches.points();
  Eigen::Matrix<double, n, 1> values;
  for (int patch = 0; patch < patches.count; ++patch) {
    for (int i = 0; i < n; ++i) values[i] = function(points[n * patch + i]);
    const Eigen::Matrix<double, n, 1> powers = turn * values;
    coefficients_.insert(coefficients_.end(), powers.begin(), powers.end());
  }
}

PatchedSurface::PatchedSurface(const Patches& x, const Patches& y, const Eigen::MatrixXd& values)
    : x_(x), y_(y) {
  const Square turn = powers_from_values();
  for (int i = 0; i < x.count; ++i) {
    for (int j = 0; j < y.count; ++j) {
      // The powers of v lie side by side.
      const Square powers =
          (turn * values.block<n, n>(n * i, n * j) * turn.transpose()).transpose();
      coefficients_.insert(coefficients_.end(), powers.data(), powers.data() + powers.size());
    }
  }
}

}  // namespace blocklift::dynamics
