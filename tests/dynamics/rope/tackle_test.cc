#include "dynamics/rope/tackle.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

// API RP 9B (2015), fast line factors and efficiencies of case A, whose sheaves are as many as its
// falls: 10 falls on roller bearings, K = 1.04, have 0.123 in the example of 2.3.3.4; 16 falls
// 0.086 and 0.728. Printed to three digits.
TEST(Tackle, LeadLineOfApiRp9b) {
  const auto lead = [](int falls) {
    return calc_shares({falls, 1, 1 / 1.04}, TackleMotion::hoisting).lead_line;
  };
  EXPECT_NEAR(lead(10), 0.123, 5e-4);
  EXPECT_NEAR(lead(16), 0.086, 5e-4);
  EXPECT_NEAR(calc_efficiency({16, 1, 1 / 1.04}), 0.728, 5e-4);
}

// Pipeline Rules of Thumb Handbook: four parts on plain bearings of 0.917, led straight to the
// hoist: 3,250 pounds by 1,000.
TEST(Tackle, MechanicalAdvantageOfPlainBearings) {
  const TackleShares shares = calc_shares({4, 1, 0.917}, TackleMotion::hoisting);
  EXPECT_NEAR(1 / shares.lead_line, 3.25, 0.02);  // three digits, and its powers rounded
}

// Sheave by sheave by hand: eta = 0.5, three falls 4, 2, 1 of 7, the lead line over two sheaves.
TEST(Tackle, FallsShareGeometrically) {
  const TackleShares up = calc_shares({3, 2, 0.5}, TackleMotion::hoisting);
  EXPECT_DOUBLE_EQ(up.lead_line, 16.0 / 7);
  EXPECT_DOUBLE_EQ(up.largest, 16.0 / 7);
  const TackleShares down = calc_shares({3, 2, 0.5}, TackleMotion::lowering);
  EXPECT_DOUBLE_EQ(down.lead_line, 0.25 / 7);
  EXPECT_DOUBLE_EQ(down.largest, 4.0 / 7);  // at the dead end
}

// What hoists loses, and what lowers keeps back: work at the drum over that at the load, n falls.
TEST(Tackle, TakesWorkBothWays) {
  for (const int falls : {1, 2, 7, 40}) {
    for (const double eta : {0.9, 0.98, 0.999}) {
      const Tackle tackle{falls, 3, eta};
      EXPECT_GT(falls * calc_shares(tackle, TackleMotion::hoisting).lead_line, 1);
      EXPECT_LT(falls * calc_shares(tackle, TackleMotion::lowering).lead_line, 1);
    }
    const TackleShares even = calc_shares({falls, 3, 1.0}, TackleMotion::lowering);
    EXPECT_DOUBLE_EQ(even.lead_line, 1.0 / falls);
    EXPECT_DOUBLE_EQ(even.largest, 1.0 / falls);
    EXPECT_DOUBLE_EQ(calc_efficiency({falls, 3, 1.0}), 1.0);
  }
}

TEST(Tackle, RejectsWhatIsNone) {
  const std::vector<Tackle> wrong{
      {0, 1, 0.98}, {4, -1, 0.98}, {4, 1, 0.0}, {4, 1, 1.01}, {4, 1, std::nan("")}};
  for (const Tackle& tackle : wrong)
    EXPECT_THROW(calc_shares(tackle, TackleMotion::hoisting), ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
