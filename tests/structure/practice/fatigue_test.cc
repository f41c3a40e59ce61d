// Rainflow counts and damage.
#include "structure/practice/fatigue.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "structure/error.h"

namespace blocklift::structure {
namespace {

Eigen::VectorXd values(std::initializer_list<double> list) {
  return Eigen::Map<const Eigen::VectorXd>(list.begin(), static_cast<Eigen::Index>(list.size()));
}

std::map<double, double> counts(const std::vector<Cycles>& cycles) {
  std::map<double, double> by_range;
  for (const Cycles& cycle : cycles) by_range[cycle.range] += cycle.count;
  return by_range;
}

// ASTM E1049-85, figure 6 and its table: the example of section 5.4.4.
TEST(Rainflow, ExampleOfTheStandard) {
  const auto found = counts(count_rainflow(values({-2, 1, -3, 5, -1, 3, -4, 4, -2})));
  const std::map<double, double> expected{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}};
  EXPECT_EQ(found, expected);
}

// ASTM E1049-85, figure 7: the same history repeated, section 5.4.5.
TEST(Rainflow, ExampleOfTheStandardRepeated) {
  const auto found = counts(count_rainflow_of_repeated(values({-2, 1, -3, 5, -1, 3, -4, 4})));
  const std::map<double, double> expected{{3, 1}, {4, 1}, {7, 1}, {9, 1}};
  EXPECT_EQ(found, expected);
}

TEST(Rainflow, IntermediateValuesAndPausesDoNotCount) {
  const auto found =
      counts(count_rainflow(values({-2, -1, 0, 1, 1, -3, -3, 0, 5, 2, -1, 3, -4, 0, 4, 4, -2})));
  const std::map<double, double> expected{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}};
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(count_rainflow(values({3, 3, 3})).empty());
  EXPECT_TRUE(count_rainflow_of_repeated(Eigen::VectorXd()).empty());
}

// DNV-RP-C203, table 2-1: curve D is class 90 MPa (FAT 90 of IIW), 52.63 MPa at 10^7 cycles, m = 3
// and 5; curve F 71 MPa and 41.52 MPa.
TEST(FatigueCurve, DnvCurves) {
  const FatigueCurve d = fatigue_curve("D"), f = fatigue_curve("F");
  EXPECT_NEAR(d.class_range, 90e6, 0.005 * 90e6);
  EXPECT_NEAR(f.class_range, 71e6, 0.005 * 71e6);
  EXPECT_NEAR(d.cycles_to_failure(52.63e6), 1e7, 0.005e7);
  EXPECT_NEAR(f.cycles_to_failure(41.52e6), 1e7, 0.005e7);
  EXPECT_NEAR(std::log10(d.cycles_to_failure(100e6)), 12.164 - 3 * 2, 1e-9);
  EXPECT_NEAR(std::log10(d.cycles_to_failure(10e6)), 15.606 - 5 * 1, 1e-9);
  EXPECT_TRUE(std::isinf(d.cycles_to_failure(0)));
  for (const std::string& name : fatigue_curve_names())
    EXPECT_NEAR(fatigue_curve(name).knee_cycles, 1e7, 0.02e7) << name;
  try {
    fatigue_curve("Q");
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("B1, B2, C"), std::string::npos);
  }
}

// DNV-RP-C203 (2016), 2.4.3 and table 2-1: log N = log a - m log(S (t / 25 mm)^k), k = 0.20 of curve
// D, 0.25 of F, 0 of B1; plates thinner than 25 mm gain nothing. 100 mm of F: sqrt(2).
TEST(FatigueCurve, CountsRangesInThickPlatesMore) {
  const FatigueCurve d = fatigue_curve("D"), f = fatigue_curve("F"), b1 = fatigue_curve("B1");
  EXPECT_NEAR(f.thickness_factor(0.100), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(std::log10(d.cycles_to_failure(100e6 * d.thickness_factor(0.050))),
              12.164 - 3 * (2 + 0.20 * std::log10(2)), 1e-9);
  for (const double thickness : {0.0, 0.012, 0.025})
    EXPECT_DOUBLE_EQ(d.thickness_factor(thickness), 1);
  EXPECT_DOUBLE_EQ(b1.thickness_factor(0.100), 1);
}

TEST(Damage, IsMinersSum) {
  const FatigueCurve d = fatigue_curve("D");
  const std::vector<Cycles> cycles{{100e6, 0, 1}, {10e6, 5e6, 0.5}};
  EXPECT_NEAR(damage(cycles, d), std::pow(10, 6 - 12.164) + 0.5 * std::pow(10, 5 - 15.606), 1e-15);
}

}  // namespace
}  // namespace blocklift::structure
