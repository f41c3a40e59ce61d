#include "tests/structure/sample_history.h"

#include <cmath>
#include <random>

namespace blocklift::structure::test {

Eigen::MatrixXd noise_history(int count, int instants, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(count, instants, [&] { return normal(random); });
}

Eigen::MatrixXd random_responses(int rows, int count, unsigned seed) {
  return noise_history(rows, count, seed);
}

Eigen::MatrixXd lift_like_history(int count, int instants, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double duration = 0.05 * instants;  // s
  Eigen::MatrixXd factors(count, instants);
  for (int k = 0; k < count; ++k) {
    const double mean = normal(random), drift = 0.5 * normal(random);
    double amplitude[3], phase[3];
    for (int i = 0; i < 3; ++i) {
      amplitude[i] = 0.1 * normal(random);
      phase[i] = 3 * normal(random);
    }
    const double period[3] = {0.9, 2.3, 11.0};  // bounce and swing, s
    for (int t = 0; t < instants; ++t) {
      const double time = 0.05 * t;
      // The swing dies out and is stirred up again at each of ten stages.
      const double fade = std::exp(-std::fmod(time, duration / 10) / 20);
      double value = mean + drift * std::sin(3 * time / duration);
      for (int i = 0; i < 3; ++i)
        value += fade * amplitude[i] * std::sin(2 * M_PI * time / period[i] + phase[i]);
      factors(k, t) = value;
    }
  }
  return factors;
}

}  // namespace blocklift::structure::test
