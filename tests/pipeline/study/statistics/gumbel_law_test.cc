#include "pipeline/study/statistics/gumbel_law.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/study/statistics/goodness_of_fit.h"

namespace blocklift::pipeline {
namespace {

/// Values at the middles of equal shares: as near to the law as a sample can be.
std::vector<double> even_values(int count, const GumbelLaw& law) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(law.quantile((i + 0.5) / count));
  return values;
}

TEST(GumbelLaw, QuantilesAndSharesAreThoseOfItsDefinition) {
  const GumbelLaw law{3, 2};
  EXPECT_NEAR(law.quantile(0.99), 3 - 2 * std::log(-std::log(0.99)), 1e-12);
  EXPECT_NEAR(law.share_below(law.quantile(0.2)), 0.2, 1e-12);
}

TEST(GumbelLaw, IsFoundAgainInItsOwnValues) {
  const GumbelLaw found = fit_gumbel(even_values(2000, {-7, 3}));
  EXPECT_NEAR(found.location, -7, 0.01);
  EXPECT_NEAR(found.scale, 3, 0.02);
}

// The likeliest law has no slope of its likelihood: the derivatives by location and scale,
// sum of 1 - e^-z and sum of z (1 - e^-z) less the number of values, are zero.
TEST(GumbelLaw, IsTheLikeliest) {
  const std::vector<double> values{1, 2, 2.5, 4, 9, 3};
  const GumbelLaw law = fit_gumbel(values);
  double by_location = 0, by_scale = -static_cast<double>(values.size());
  for (const double value : values) {
    const double reduced = (value - law.location) / law.scale;
    by_location += 1 - std::exp(-reduced);
    by_scale += reduced * (1 - std::exp(-reduced));
  }
  EXPECT_NEAR(by_location, 0, 1e-9);
  EXPECT_NEAR(by_scale, 0, 1e-9);
}

// Of many values the interval is the normal one: the variance of the quantile with the reduced
// value y is (1.109 + 0.514 y + 0.608 y^2) scale^2 / n (Johnson, Kotz and Balakrishnan 1995,
// chapter 22).
TEST(GumbelLaw, IntervalOfManyValuesIsTheNormalOne) {
  constexpr int count = 20000;
  const std::vector<double> values = even_values(count, {100, 5});
  const auto [low, high] = gumbel_quantile_interval(values, 0.999);
  const double y = -std::log(-std::log(0.999));
  const double deviation = 5 * std::sqrt((1.109 + 0.514 * y + 0.608 * y * y) / count);
  EXPECT_NEAR(high - low, 2 * 1.96 * deviation, 0.02 * deviation);
  EXPECT_NEAR((high + low) / 2, fit_gumbel(values).quantile(0.999), 0.05 * deviation);
}

TEST(GumbelLaw, HasNoUnitAndNoZeroOfItsOwn) {
  std::vector<double> values = even_values(40, {3, 1}), others = values;
  for (double& value : others) value = 1000 * value - 1e5;
  const auto [low, high] = gumbel_quantile_interval(values, 0.999);
  const auto [other_low, other_high] = gumbel_quantile_interval(others, 0.999);
  EXPECT_NEAR(other_low, 1000 * low - 1e5, 1e-3);
  EXPECT_NEAR(other_high, 1000 * high - 1e5, 1e-3);
  const double value = fit_gumbel(values).quantile(0.999);
  EXPECT_LT(low, value);
  EXPECT_GT(high - value, value - low);  // more may be than less
}

TEST(GumbelLaw, RefusesWhatHasNone) {
  EXPECT_THROW(fit_gumbel({1, 2}), std::invalid_argument);
  EXPECT_THROW(fit_gumbel({4, 4, 4, 4}), std::invalid_argument);
}

// Anderson and Darling's statistic by hand: of one value in the middle -1 - ln(1/4).
TEST(GoodnessOfFit, StatisticByHand) {
  EXPECT_NEAR(anderson_darling({0.5}), -1 + std::log(4), 1e-12);
  const double two = -2 - (std::log(0.2) + std::log(0.4) + 3 * (std::log(0.6) + std::log(0.8))) / 2;
  EXPECT_NEAR(anderson_darling({0.6, 0.2}), two, 1e-12);
  EXPECT_FALSE(std::isfinite(anderson_darling({0, 0.5, 0.7})));
}

// Of many values of a Gumbel law with location and scale fitted (Stephens 1977, of the statistic
// times 1 + 0.2 / sqrt(n)), to the three digits given.
TEST(GoodnessOfFit, GumbelsPointsAreThePublishedOnes) {
  EXPECT_NEAR(p_of_gumbel_fit(0.474), 0.25, 0.005);
  EXPECT_NEAR(p_of_gumbel_fit(0.637), 0.10, 0.002);
  EXPECT_NEAR(p_of_gumbel_fit(0.757), 0.05, 0.001);
  EXPECT_NEAR(p_of_gumbel_fit(0.877), 0.025, 0.0005);
  EXPECT_NEAR(p_of_gumbel_fit(1.038), 0.01, 0.0003);
}

// Of an exponential tail with scale and shape fitted (Choulakian and Stephens 2001, table 2, k = 0).
TEST(GoodnessOfFit, ParetosPointsAreThePublishedOnes) {
  EXPECT_NEAR(p_of_pareto_fit(0.796, 0), 0.10, 0.001);
  EXPECT_NEAR(p_of_pareto_fit(0.974, 0), 0.05, 0.0005);
  // Continuous about zero, where the formulae are others.
  EXPECT_NEAR(p_of_pareto_fit(0.974, 1e-3), p_of_pareto_fit(0.974, -1e-3), 2e-4);
  EXPECT_NEAR(p_of_pareto_fit(0.974, 1.01e-4), p_of_pareto_fit(0.974, 0.99e-4), 2e-5);
}

TEST(GoodnessOfFit, FarAndNearEnds) {
  EXPECT_EQ(p_of_gumbel_fit(std::numeric_limits<double>::infinity()), 0);
  EXPECT_LT(p_of_gumbel_fit(20), 1e-6);
  EXPECT_EQ(p_of_gumbel_fit(1e6), 0);
  EXPECT_GT(p_of_gumbel_fit(0.05), 0.999);
  EXPECT_GT(p_of_pareto_fit(0.05, 3), 0.99);
}

}  // namespace
}  // namespace blocklift::pipeline
