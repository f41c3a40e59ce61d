#include "pipeline/study/statistics/spread.h"

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

std::vector<int> numbers(std::size_t count) {
  std::vector<int> list(count);
  std::iota(list.begin(), list.end(), 0);
  return list;
}

/// A sample at the middles of equal shares of a law: as near to the law as a sample can be.
template <class Inverse>
std::vector<double> even_sample(int count, const Inverse& inverse) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(inverse((i + 0.5) / count));
  return values;
}

// The 40th and the 61st of 100 values hold the median at 95 % (David and Nagaraja 2003, 7.1).
TEST(Quantile, MedianOfAHundredLiesBetweenTheirFortiethAndSixtyFirst) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Quantile median = find_quantile(values, 0.5);
  EXPECT_DOUBLE_EQ(median.value, 50.5);
  EXPECT_EQ(median.low, 40);
  EXPECT_EQ(median.high, 61);
}

TEST(Quantile, SaysWhereTheSampleIsTooSmall) {
  std::vector<double> values(50);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_FALSE(std::isfinite(find_quantile(values, 0.99).high));
  EXPECT_TRUE(std::isfinite(find_quantile(values, 0.99).low));
}

// By n independent values the largest lies beyond the quantile p with the probability 1 - p^n: 97.5
// % from 72 on for 95 %, from 368 on for 99 %, from 6 on for the median (David and Nagaraja 2003,
// 7.1).
TEST(Quantile, HasBothEndsFromAKnownNumberOn) {
  for (const auto& [share, fewest] :
       {std::pair{0.5, 6}, std::pair{0.95, 72}, std::pair{0.99, 368}}) {
    EXPECT_EQ(fewest_for_interval(share), fewest);
    std::vector<double> values(static_cast<std::size_t>(fewest));
    std::iota(values.begin(), values.end(), 1.0);
    EXPECT_EQ(find_quantile(values, share).high, fewest);
    values.pop_back();
    EXPECT_FALSE(std::isfinite(find_quantile(values, share).high));
  }
}

TEST(Quantile, OfOneValueAndOfTies) {
  const Quantile one = find_quantile({3}, 0.95);
  EXPECT_EQ(one.value, 3);
  EXPECT_FALSE(std::isfinite(one.low) || std::isfinite(one.high));
  const Quantile tied = find_quantile(std::vector<double>(100, 7.0), 0.5);
  EXPECT_EQ(tied.value, 7);
  EXPECT_EQ(tied.low, 7);
  EXPECT_EQ(tied.high, 7);
}

// Of one value nobody knows the deviation. What differs by rounding alone depends on nothing, has
// no law, and is said to be the same.
TEST(Spread, OfWhatDoesNotVary) {
  Eigen::MatrixXd design(40, 1);
  design.col(0).setLinSpaced(0, 39);
  const Spread one = find_spread("x", {4}, {0}, design);
  EXPECT_TRUE(std::isnan(one.deviation));
  EXPECT_FALSE(one.varies);
  EXPECT_EQ(one.mean, 4);
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(1e5 * (1 + 1e-12 * i));
  const Spread rounded = find_spread("x", values, numbers(40), design);
  EXPECT_FALSE(rounded.varies);
  EXPECT_EQ(rounded.rank_correlation[0], 0);
  EXPECT_TRUE(rounded.extremes.empty());
  EXPECT_FALSE(find_spread("x", std::vector<double>(40), numbers(40), design).varies);
  values[7] *= 1.01;
  EXPECT_TRUE(find_spread("x", values, numbers(40), design).varies);
}

// A figure that takes two values alone, as a discrete variable may make it: no law of extremes is
// like that, and none is said to fit.
TEST(Spread, NoLawFitsTwoValues) {
  std::vector<double> values(400, 1.0);
  for (std::size_t i = 0; i < values.size(); i += 5) values[i] = 2;
  Eigen::MatrixXd design(400, 2);
  for (Eigen::Index i = 0; i < 400; ++i) design.row(i) << (i % 5 == 0 ? 1 : 0), 3;
  const Spread spread = find_spread("x", values, numbers(400), design);
  for (const ExtremeFit& fit : spread.extremes) {
    EXPECT_LT(fit.p_value, 0.05) << fit.law;
    EXPECT_TRUE(fit.low <= fit.value && fit.value <= fit.high) << fit.law;
  }
  EXPECT_NEAR(spread.rank_correlation[0], 1, 1e-12);  // ties share their rank
  EXPECT_EQ(spread.rank_correlation[1], 0);           // with what has one value
}

TEST(Spread, MomentsAndTheirMembers) {
  Eigen::MatrixXd design(8, 1);
  design.col(0).setLinSpaced(0, 7);
  const Spread spread = find_spread("x", {4, 1, 7, 4}, {0, 2, 5, 7}, design);
  EXPECT_DOUBLE_EQ(spread.mean, 4);
  EXPECT_DOUBLE_EQ(spread.deviation, std::sqrt(6.0));
  EXPECT_EQ(spread.member_of_smallest, 2);
  EXPECT_EQ(spread.member_of_largest, 5);
  EXPECT_TRUE(spread.extremes.empty());
}

// What is bad when it is small has its extremes at the other end: the mirror of the same sample.
TEST(Spread, SmallIsBadMirrorsLargeIsBad) {
  const auto inverse = [](double share) { return 100 - 5 * std::log(-std::log(share)); };
  std::vector<double> values = even_sample(500, inverse), mirrored;
  for (const double value : values) mirrored.push_back(-value);
  const Eigen::MatrixXd design(500, 0);
  const Spread large = find_spread("x", values, numbers(500), design);
  const Spread small = find_spread("x", mirrored, numbers(500), design, true);
  EXPECT_EQ(small.worst(), -large.worst());
  EXPECT_EQ(small.member_of_worst(), large.member_of_worst());
  EXPECT_EQ(large.quantile_of_better(0.99).share, 0.99);
  EXPECT_EQ(small.quantile_of_better(0.99).share, 0.01);
  EXPECT_NEAR(small.quantile_of_better(0.95).value, -large.quantile_of_better(0.95).value, 1e-9);
  ASSERT_EQ(small.extremes.size(), large.extremes.size());
  for (std::size_t i = 0; i < small.extremes.size(); ++i) {
    EXPECT_EQ(small.extremes[i].value, -large.extremes[i].value);
    EXPECT_EQ(small.extremes[i].low, -large.extremes[i].high);
    EXPECT_EQ(small.extremes[i].high, -large.extremes[i].low);
  }
}

TEST(Spread, RanksOfAMonotoneFigureAgree) {
  Eigen::MatrixXd design(20, 2);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < 20; ++i) {
    design(i, 0) = static_cast<double>(i);
    design(i, 1) = static_cast<double>((7 * i) % 20);
    values.push_back(std::exp(-0.3 * static_cast<double>(i)));
  }
  const Spread spread = find_spread("x", values, numbers(20), design);
  EXPECT_NEAR(spread.rank_correlation[0], -1, 1e-12);
  EXPECT_LT(std::abs(spread.rank_correlation[1]), 0.5);
}

TEST(Spread, GumbelOfItsOwnSample) {
  const auto inverse = [](double share) { return 100 - 5 * std::log(-std::log(share)); };
  const Spread spread =
      find_spread("x", even_sample(500, inverse), numbers(500), Eigen::MatrixXd(500, 0));
  ASSERT_FALSE(spread.extremes.empty());
  const ExtremeFit& fit = spread.extremes.front();
  EXPECT_EQ(fit.law, "Gumbel");
  EXPECT_GT(fit.p_value, 0.5);
  EXPECT_NEAR(fit.value, inverse(0.999), 0.02 * (inverse(0.999) - 100));
  EXPECT_LT(fit.low, inverse(0.999));
  EXPECT_GT(fit.high, inverse(0.999));
}

// Kolmogorov's own table, for a law that is known, says 0.23 of these values and a Gumbel law that
// was fitted to them: tables of known laws do not hold.
TEST(Spread, GumbelDoesNotFitWhatIsSpreadEvenly) {
  const Spread spread = find_spread("x", even_sample(100, [](double share) { return share; }),
                                    numbers(100), Eigen::MatrixXd(100, 0));
  ASSERT_FALSE(spread.extremes.empty());
  EXPECT_LT(spread.extremes.front().p_value, 0.05);
}

// The excesses of an exponential law over any threshold are exponential: Pareto's with shape 0.
// Of 100 excesses the quantile at 1 in 100 has a standard error of 11 % (covariance of Smith,
// 1987): a sample that is drawn evenly must come about as near. Below 0.05 the page says "no fit".
TEST(Spread, ParetoOfAnExponentialTail) {
  const auto inverse = [](double share) { return -3 * std::log(1 - share); };
  const Spread spread =
      find_spread("x", even_sample(1000, inverse), numbers(1000), Eigen::MatrixXd(1000, 0));
  ASSERT_EQ(spread.extremes.size(), 2U);
  const ExtremeFit& fit = spread.extremes.back();
  EXPECT_GT(fit.p_value, 0.2);
  EXPECT_NEAR(fit.value, inverse(0.999), 0.15 * inverse(0.999));
  // A Gumbel law has no such beginning.
  EXPECT_LT(spread.extremes.front().p_value, 0.05);
}

// Members that share the value at the 90 % quantile, as those do that a bound or a discrete value
// holds there: the tail above them is what it is, and its fit has a statistic. Bounds as above.
TEST(Spread, ParetoWhereValuesTieAtTheThreshold) {
  const auto inverse = [](double share) { return -3 * std::log(1 - share); };
  std::vector<double> values = even_sample(1000, inverse);
  for (std::size_t i = 860; i < 900; ++i) values[i] = values[900];
  const Spread spread = find_spread("x", values, numbers(1000), Eigen::MatrixXd(1000, 0));
  ASSERT_EQ(spread.extremes.size(), 2U);
  const ExtremeFit& fit = spread.extremes.back();
  EXPECT_GT(fit.p_value, 0.2);
  EXPECT_NEAR(fit.value, inverse(0.999), 0.15 * inverse(0.999));
}

}  // namespace
}  // namespace blocklift::pipeline
