#include "dynamics/algebra/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace blocklift::dynamics {

QuadratureRule make_gauss_legendre(int order) {
  const auto n = static_cast<std::size_t>(order);
  QuadratureRule rule{std::vector<double>(n, 0.0), std::vector<double>(n)};
  constexpr int most_steps = 10;
  for (std::size_t i = 0; 2 * i < n; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (order + 0.5));
    double slope = 0.0;
    for (int step = 0; step < most_steps; ++step) {
      double before = 1.0, value = x;
      for (int k = 2; k <= order; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = order * (x * value - before) / (x * x - 1.0);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    if (2 * i + 1 == n) x = 0.0;
    rule.points[i] = x;
    rule.points[n - 1 - i] = -x;
    rule.weights[i] = rule.weights[n - 1 - i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace blocklift::dynamics
