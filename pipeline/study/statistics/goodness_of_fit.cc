#include "pipeline/study/statistics/goodness_of_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

namespace blocklift::pipeline {
namespace {

constexpr int terms = 48;  // of the sum; of those behind, the mean is kept

/// How the share below a value moves with the two parameters of a law, over the law's shares t, and
/// the covariance of the parameters' likeliest values times the number of values.
struct FittedLaw {
  std::function<Eigen::Vector2d(double t)> derivatives;
  Eigen::Matrix2d covariance;
};

/// The weights of the squares that the statistic is a sum of.
struct EigenvaluesOfFit {
  Eigen::VectorXd values;
  double mean_of_rest = 0;
};

/// The statistic of a law that is known is the sum over j of squares of independent normal values
/// over j (j + 1), of eigenfunctions sqrt(t (1 - t)) P_j'(2 t - 1), Legendre's polynomials
/// (Anderson and Darling 1952). The fit takes two directions out of it.
EigenvaluesOfFit eigenvalues_of(const FittedLaw& law) {
  constexpr int points = 1000;
  Eigen::MatrixXd taken = Eigen::MatrixXd::Zero(terms, 2);
  for (int k = 0; k < points; ++k) {
    // Points that crowd towards both ends.
    const double angle = std::numbers::pi * (k + 0.5) / points;
    const double t = (1 - std::cos(angle)) / 2;
    const double x = -std::cos(angle);
    const double weight = std::numbers::pi / points * std::sin(angle) / 2;
    const Eigen::Vector2d derivatives = law.derivatives(t);
    double legendre = x, legendre_before = 1, slope = 1, slope_before = 0;
    for (int j = 1; j <= terms; ++j) {
      const double norm = 2 * std::sqrt((2.0 * j + 1) / (j * (j + 1.0)));
      taken.row(j - 1) += weight * norm * slope * derivatives.transpose();
      const double slope_next = slope_before + (2 * j + 1) * legendre;
      slope_before = std::exchange(slope, slope_next);
      const double next = ((2 * j + 1) * x * legendre - j * legendre_before) / (j + 1);
      legendre_before = std::exchange(legendre, next);
    }
  }
  Eigen::MatrixXd kernel = -taken * law.covariance * taken.transpose();
  for (int j = 1; j <= terms; ++j) kernel(j - 1, j - 1) += 1 / (j * (j + 1.0));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(kernel, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().cwiseMax(0), 1.0 / (terms + 1)};
}

/// The probability that a weighted sum of squares of independent normal values is larger than a
/// value, by inversion of its characteristic function (Davies 1973).
double probability_above(double value, const Eigen::VectorXd& weights) {
  constexpr double negligible = 1e-7;
  const double step = 2 * std::numbers::pi / (value + 20 * weights.sum());
  double sum = 0;
  for (int k = 0;; ++k) {
    const double u = (k + 0.5) * step;
    double logarithm = 0, angle = -u * value;
    for (const double weight : weights) {
      logarithm -= std::log1p(4 * weight * weight * u * u) / 4;
      angle += std::atan(2 * weight * u) / 2;
    }
    const double size = std::exp(logarithm);
    sum += size * std::sin(angle) / (k + 0.5);
    if (size < negligible) break;
  }
  return std::clamp(0.5 + sum / std::numbers::pi, 0.0, 1.0);
}

double p_of_fit(double statistic, const FittedLaw& law) {
  // Farther out less than 1e-40 is left, and the integral takes the longer the farther it is.
  constexpr double far = 100;
  if (!(statistic < far)) return 0;
  const auto [weights, mean_of_rest] = eigenvalues_of(law);
  return probability_above(statistic - mean_of_rest, weights);
}

}  // namespace

double anderson_darling(std::vector<double> shares) {
  std::ranges::sort(shares);
  const std::size_t count = shares.size();
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum += (2 * static_cast<double>(i) + 1) *
           (std::log(shares[i]) + std::log1p(-shares[count - 1 - i]));
  const auto n = static_cast<double>(count);
  return -n - sum / n;
}

double p_of_gumbel_fit(double statistic) {
  constexpr double pi = std::numbers::pi;
  const double of_scale = 6 / (pi * pi), of_both = of_scale * (1 - std::numbers::egamma);
  const double of_location = 1 + of_both * (1 - std::numbers::egamma);
  FittedLaw law;
  law.derivatives = [](double t) {
    const double density = -t * std::log(t);
    return Eigen::Vector2d(-density, density * std::log(-std::log(t)));
  };
  law.covariance << of_location, of_both, of_both, of_scale;
  return p_of_fit(statistic, law);
}

double p_of_pareto_fit(double statistic, double shape) {
  constexpr double straight = 1e-4;
  FittedLaw law;
  law.derivatives = [shape](double t) {
    const double above = 1 - t, logarithm = std::log(above);
    if (std::abs(shape) < straight)
      return Eigen::Vector2d(above * logarithm, -above * logarithm * logarithm / 2);
    const double power = std::expm1(shape * logarithm);
    return Eigen::Vector2d(above * power / shape, above * (logarithm - power / shape) / shape);
  };
  law.covariance << 2, -1, -1, 1 + shape;
  law.covariance *= 1 + shape;
  return p_of_fit(statistic, law);
}

}  // namespace blocklift::pipeline
