#include "structure/practice/column.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

/// A pipe of 406.4 x 12.5 mm in S355.
Column pipe_column(double length) {
  Column column;
  const double outer = 0.2032, inner = outer - 0.0125;
  const double pi = std::acos(-1.0);
  column.area = pi * (outer * outer - inner * inner);
  const double moment = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
  column.second_moments = {moment, moment};
  column.section_moduli = {moment / outer, moment / outer};
  column.yield_stress = 355e6;
  column.length = length;
  column.curve = BucklingCurve::a;
  return column;
}

// Figures that tables of the curves print for a slenderness of 0.5, 1 and 2.
TEST(BucklingReduction, IsThatOfThePublishedCurves) {
  const auto expect = [](BucklingCurve curve, double half, double one, double two) {
    EXPECT_NEAR(buckling_reduction(0.5, curve), half, 1e-4);
    EXPECT_NEAR(buckling_reduction(1, curve), one, 1e-4);
    EXPECT_NEAR(buckling_reduction(2, curve), two, 1e-4);
  };
  expect(BucklingCurve::a, 0.9243, 0.6656, 0.2229);
  expect(BucklingCurve::b, 0.8842, 0.5970, 0.2095);
  expect(BucklingCurve::c, 0.8430, 0.5399, 0.1962);
  expect(BucklingCurve::d, 0.7793, 0.4671, 0.1766);
  EXPECT_EQ(buckling_reduction(0.2, BucklingCurve::d), 1);
  EXPECT_EQ(buckling_reduction(0.1, BucklingCurve::a0), 1);
}

// A slender bar fails at Euler's load, of which its imperfections take a few per cent.
TEST(BucklingResistance, OfASlenderBarTendsToEulersLoad) {
  const Column column = pipe_column(60);
  const double euler = euler_load(column, 0);
  EXPECT_NEAR(euler, std::pow(std::acos(-1.0), 2) * 210e9 * column.second_moments[0] / 3600, 1e-6);
  EXPECT_LT(buckling_resistance(column), euler);
  EXPECT_GT(buckling_resistance(column), 0.94 * euler);
}

TEST(BucklingResistance, OfASquatBarIsItsYield) {
  const Column column = pipe_column(1);
  EXPECT_NEAR(buckling_resistance(column), column.area * column.yield_stress, 1e-6);
}

TEST(BucklingResistance, IsThatOfTheWeakerAxis) {
  Column column = pipe_column(12);
  column.second_moments[1] /= 4;
  Column weak = pipe_column(12);
  weak.second_moments = {column.second_moments[1], column.second_moments[1]};
  EXPECT_NEAR(buckling_resistance(column), buckling_resistance(weak), 1e-6);
}

TEST(ColumnUtilisation, IsOneAtTheResistance) {
  const Column column = pipe_column(12);
  EXPECT_NEAR(column_utilisation(column, {buckling_resistance(column) / 1.5, {}}, 1.5), 1, 1e-12);
}

TEST(ColumnUtilisation, LetsMomentsGrowWithTheCompression) {
  const Column column = pipe_column(12);
  const double N = 0.25 * euler_load(column, 0), M = 10e3;
  const double alone = column_utilisation(column, {N, {}}, 1);
  const double bent = M / (column.section_moduli[0] * column.yield_stress);
  EXPECT_NEAR(column_utilisation(column, {N, {M, 0}}, 1), alone + bent / 0.75, 1e-12);
  EXPECT_NEAR(column_utilisation(column, {N, {0, -M}}, 1), alone + bent / 0.75, 1e-12);
  EXPECT_NEAR(column_utilisation(column, {-N, {M, 0}}, 1),
              N / (column.area * column.yield_stress) + bent, 1e-12);
  EXPECT_EQ(column_utilisation(column, {euler_load(column, 0), {}}, 1),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace blocklift::structure
