#include "dynamics/marine/green/deep_water_integral.h"

#include <cmath>
#include <numbers>

#include "dynamics/algebra/gauss_legendre.h"

namespace blocklift::dynamics {
namespace {

/// W with t = Y - u = X sinh v: an integrand without singularities.
double line_integral(double X, double Y) {
  constexpr double nothing = 42.0;  // exp(-42) is below the last digit
  constexpr int pieces = 4;
  static const QuadratureRule rule = make_gauss_legendre(32);
  const double from = std::asinh((Y - nothing) / X), to = std::asinh(Y / X);
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      sum += rule.weights[i] * std::exp(X * std::sinh(middle + half * rule.points[i]) - Y);
    }
  }
  return half * sum;
}

template <class Function>
PatchedSurface make_patched(const Patches& x, const Patches& y, const Function& function) {
  const std::vector<double> at_x = x.points(), at_y = y.points();
  Eigen::MatrixXd values(at_x.size(), at_y.size());
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) values(i, j) = function(at_x[i], at_y[j]);
  }
  return {x, y, values};
}

}  // namespace

DeepWaterIntegral::DeepWaterIntegral() {
  near_ = make_patched({0.0, near, 16}, {0.0, 1.0, 12}, [](double rho, double c) {
    const double X = rho * std::sqrt(1.0 - c * c), Y = rho * c;
    return std::exp(-Y) * (std::cyl_bessel_j(0, X) * std::log(rho) -
                           std::numbers::pi * std::cyl_neumann(0, X)) -
           line_integral(X, Y);
  });
  far_ = make_patched({0.0, 1.0, 4}, {0.0, 1.0, 6}, [](double t, double c) {
    const double rho = near / t;
    return rho * line_integral(rho * std::sqrt(1.0 - c * c), rho * c);
  });
}

const DeepWaterIntegral& DeepWaterIntegral::tables() {
  static const DeepWaterIntegral integral;
  return integral;
}

}  // namespace blocklift::dynamics
