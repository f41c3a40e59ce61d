#include "pipeline/measurement/decay.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

/// 100 + 12 e^(-s t) cos(w t + 0.4), with white noise, from 50 s on.
TimeSeries swinging(double period, double damping, double noise, double length = 40) {
  std::mt19937 random(11);
  std::normal_distribution<double> error(0, 1);
  const double frequency = 2 * std::numbers::pi / period;
  const double rate = frequency * damping / std::sqrt(1 - damping * damping);
  TimeSeries series;
  for (int i = 0; i * 0.1 <= length; ++i) {
    const double t = i * 0.1;
    series.time.push_back(50 + t);
    series.values.push_back(100 + 12 * std::exp(-rate * t) * std::cos(frequency * t + 0.4) +
                            noise * error(random));
  }
  return series;
}

TEST(FitDecay, FindsPeriodAndDampingOfAFreeOscillation) {
  for (const double period : {0.9, 3.7, 11.0})
    for (const double damping : {0.0, 0.015, 0.12}) {
      const auto decay = fit_decay(swinging(period, damping, 0));
      ASSERT_TRUE(decay) << period << " s, " << damping;
      EXPECT_NEAR(decay->period, period, 1e-6 * period);
      EXPECT_NEAR(decay->damping_ratio, damping, 1e-7);
      EXPECT_NEAR(decay->amplitude, 12, 1e-5);
      EXPECT_GT(decay->explained, 0.999999);
    }
}

// Ten minutes at ten samples a second: the scan looks at means of two.
TEST(FitDecay, FindsThemInALongRecord) {
  for (const double period : {1.1, 6.3, 37.0}) {
    const auto decay = fit_decay(swinging(period, 0.0004, 0.5, 600));
    ASSERT_TRUE(decay) << period;
    EXPECT_LT(std::abs(decay->period - period), 4 * decay->period_deviation);
    EXPECT_LT(std::abs(decay->damping_ratio - 0.0004), 4 * decay->damping_deviation);
  }
}

TEST(FitDecay, SaysHowFarNoiseMovesThem) {
  const auto decay = fit_decay(swinging(3.7, 0.015, 1));
  ASSERT_TRUE(decay);
  EXPECT_GT(decay->period_deviation, 0);
  EXPECT_LT(decay->period_deviation, 0.01);
  EXPECT_LT(std::abs(decay->period - 3.7), 4 * decay->period_deviation);
  EXPECT_LT(decay->damping_deviation, 0.003);
  EXPECT_LT(std::abs(decay->damping_ratio - 0.015), 4 * decay->damping_deviation);
}

TEST(FitDecay, FindsNothingWhereNothingSwings) {
  EXPECT_FALSE(fit_decay(swinging(3.7, 0.015, 100)));   // noise alone
  EXPECT_FALSE(fit_decay(swinging(100, 0.015, 0)));     // less than a period and a half
  EXPECT_FALSE(fit_decay(swinging(3.7, 0.015, 0, 1)));  // too few samples
  EXPECT_FALSE(fit_decay({{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, std::vector<double>(13, 5)}));
}

}  // namespace
}  // namespace blocklift::pipeline
