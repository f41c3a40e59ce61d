#include "algebra/quantile.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace blocklift::algebra {
namespace {

// Of 1, 2, 4, 8 the third quarter ends at the place 0.75 x 3 = 2.25, a quarter on from 4 to 8.
TEST(Quantile, IsLinearBetweenTheValuesInTheirOrder) {
  const std::vector<double> values{8, 1, 4, 2};
  EXPECT_DOUBLE_EQ(quantile_of(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.75), 5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 1), 8);
  EXPECT_DOUBLE_EQ(quantile_of({7}, 0.3), 7);
}

TEST(Quantile, IsTheSameOfSortedValues) {
  std::vector<double> values;
  for (int i = 0; i < 97; ++i) values.push_back(static_cast<double>((37 * i) % 97) - 40);
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.0, 0.01, 0.2, 0.5, 0.77, 0.99, 1.0}) {
    EXPECT_NEAR(quantile_of(values, share), 96 * share - 40, 1e-12) << share;
    EXPECT_NEAR(quantile_of_sorted(sorted, share), 96 * share - 40, 1e-12) << share;
  }
}

}  // namespace
}  // namespace blocklift::algebra
