#include "pipeline/measurement/agreement.h"

#include <cmath>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

TEST(CompareSeries, HasDifferencesScaleAndZero) {
  const TimeSeries computed{{0, 1, 2, 3, 4}, {10, 20, 30, 20, 10}};
  const TimeSeries at_rest{{0, 4}, {12, 12}};
  TimeSeries measured{{-1, 0.5, 1.5, 2, 3.5, 9}, {}};
  for (const double t : measured.time) measured.values.push_back(3 + 1.2 * computed.at(t));
  const auto agreement = compare_series(measured, computed, at_rest, {0, 4});
  ASSERT_TRUE(agreement);
  EXPECT_EQ(agreement->samples, 4u);
  ASSERT_TRUE(agreement->scale);
  EXPECT_NEAR(*agreement->scale, 1.2, 1e-12);
  EXPECT_NEAR(agreement->zero, 3, 1e-12);
  // Computed: 15, 25, 30, 15. Differences are 3 + a fifth of them: 6, 8, 9, 6.
  EXPECT_NEAR(agreement->mean_difference, 29.0 / 4, 1e-12);
  EXPECT_NEAR(agreement->rms_difference, std::sqrt((36.0 + 64 + 81 + 36) / 4), 1e-12);
  EXPECT_NEAR(agreement->peak_difference, 9, 1e-12);
  EXPECT_EQ(agreement->time_of_peak, 2);
  EXPECT_NEAR(agreement->correlation, 1, 1e-12);
  EXPECT_NEAR(agreement->largest_measured, 39, 1e-12);
  EXPECT_EQ(agreement->largest_computed, 30);
}

TEST(CompareSeries, IsSilentWithoutCommonTime) {
  const TimeSeries computed{{0, 1, 2}, {1, 2, 3}};
  EXPECT_FALSE(compare_series({{5, 6, 7}, {1, 1, 1}}, computed, {}, {0, 10}));
  EXPECT_FALSE(compare_series({{0, 1, 2}, {1, 1, 1}}, computed, {}, {0.4, 0.6}));
}

TEST(FindSharing, AveragesSharesWhereTheLoadHangs) {
  const TimeSeries a{{0, 1, 2}, {0, 30, 30}};
  const TimeSeries b{{0, 1, 2}, {1, 70, 70}};
  const TimeSeries half{{0, 2}, {50, 50}};
  const auto shares = find_sharing({a, b}, {half, half}, {0, 2});
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_NEAR(shares[0].measured, 0.3, 1e-12);
  EXPECT_NEAR(shares[1].measured, 0.7, 1e-12);
  EXPECT_NEAR(shares[0].computed, 0.5, 1e-12);
}

// Between two samples far apart a line would make shares that nobody measured.
TEST(FindSharing, PassesOverGaps) {
  TimeSeries a, b, half;
  for (int t = 0; t <= 60; ++t) {
    half.time.push_back(t);
    half.values.push_back(50);
    a.time.push_back(t);
    a.values.push_back(t == 20 || t == 40 ? 90 : 30);
    if (t > 20 && t < 40) continue;  // the cell is silent; what lies between is not 70
    b.time.push_back(t);
    b.values.push_back(t == 20 || t == 40 ? 10 : 70);
  }
  ASSERT_EQ(gaps_of(b).size(), 1u);
  EXPECT_EQ(gaps_of(b)[0].from, 20);
  EXPECT_EQ(gaps_of(b)[0].to, 40);
  EXPECT_TRUE(gaps_of(a).empty());
  const auto shares = find_sharing({a, b}, {half, half}, {0, 60});
  EXPECT_NEAR(shares[0].measured, (40 * 0.3 + 2 * 0.9) / 42, 1e-12);
}

}  // namespace
}  // namespace blocklift::pipeline
