// Factors by themselves, worked by hand from the standards' tables to the digits that these print.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/standards/sling_factor.h"
#include "pipeline/standards/two_hooks.h"
#include "structure/practice/padeye_formulas.h"
#include "tests/pipeline/standards/shipped_rules.h"

namespace blocklift::pipeline {
namespace {

using test::shipped_rules;

constexpr double degree = std::numbers::pi / 180;

// GL Noble Denton 0027/ND rev. 11.2, appendix B.1, for L 25, a 10, b 14, c 12, d 13, x 0.9, z 0.8
// m.
TEST(TwoHooks, ShareTheWeightByTheFormulaOfTheGuideline) {
  const TwoHooks first{12, 10, 13, 14, 0.9, 0.8}, second{13, 14, 12, 10, 0.9, 0.8};
  const double half_a_digit = 0.5e-3;
  EXPECT_NEAR(share_of_hook(first, 0), 0.556, half_a_digit);
  EXPECT_NEAR(share_of_hook(first, 3 * degree), 0.582, half_a_digit);
  EXPECT_NEAR(share_of_hook(first, 5 * degree), 0.599, half_a_digit);
  EXPECT_NEAR(share_of_hook(second, 0), 0.516, half_a_digit);
  EXPECT_NEAR(share_of_hook(second, 3 * degree), 0.543, half_a_digit);
  EXPECT_NEAR(share_of_hook(second, 5 * degree), 0.562, half_a_digit);
}

// Without tolerances the two shares are the whole weight: tilted one way on one hook and the other
// way on the other.
TEST(TwoHooks, BearTheWholeWeight) {
  const TwoHooks first{12, 10, 13, 14}, second{13, 14, 12, 10};
  for (const double tilt : {-0.2, 0.0, 0.1})
    EXPECT_NEAR(share_of_hook(first, tilt) + share_of_hook(second, -tilt), 1, 1e-14);
  EXPECT_GT(tilt_factor(first, 0.05), 1);
  // Lift points at the height of the centre: tilt changes nothing.
  EXPECT_NEAR(tilt_factor({12, 0, 13, 0}, 0.05), 1, 1e-14);
}

// 0027/ND 5.4.2, B.1.2: arcsin(1.0 / 25) = 2.29 degrees, so that 3 degrees govern; the height does
// below 19.1 m. Hooks 3.2 m apart: arcsin(1.0 / 3.2) = 18.21 degrees. Lift points at different
// heights change nothing: L is the distance between the cranes.
TEST(TwoHooks, TiltByTheLargerOfAngleAndHeight) {
  const double three = 3 * degree, half_a_digit = 0.005 * degree;
  EXPECT_DOUBLE_EQ(*tilt_angle({12, 10, 13, 14}, 0, 1.0), std::asin(1.0 / 25));
  EXPECT_NEAR(*tilt_angle({12, 10, 13, 14}, 0, 1.0), 2.29 * degree, half_a_digit);
  EXPECT_DOUBLE_EQ(*tilt_angle({12, 10, 13, 14}, three, 1.0), three);
  EXPECT_DOUBLE_EQ(*tilt_angle({9.6, 2, 9.6, 2}, three, 1.0), three);
  EXPECT_GT(*tilt_angle({9.5, 2, 9.5, 2}, three, 1.0), three);
  EXPECT_NEAR(*tilt_angle({1.6, 2, 1.6, 2}, three, 1.0), 18.21 * degree, half_a_digit);
  EXPECT_NEAR(*tilt_angle({1.6, 2, 1.6, 7}, three, 1.0), 18.21 * degree, half_a_digit);
  EXPECT_DOUBLE_EQ(*tilt_angle({1.6, 2, 1.6, 2}, three, {}), three);
  EXPECT_FALSE(tilt_angle({0.4, 2, 0.5, 2}, three, 1.0));
}

// Ropes do not press. Centre 4 m below lift points 3.2 m apart: at 18.21 degrees the centre lies
// 4 tan 18.21 = 1.316 m nearer to the higher of them, P/W = 0.5 + 1.316 / 3.2; 5 m below it would
// lie beyond it, and the formula would have a hook bear more than all.
TEST(TwoHooks, BearNoMoreThanAll) {
  const TwoHooks near{1.6, 4, 1.6, 4}, beyond{1.6, 5, 1.6, 5};
  const double tilt = std::asin(1.0 / 3.2);
  EXPECT_NEAR(tilt_factor(near, tilt), 1 + 2 * 4 * std::tan(tilt) / 3.2, 1e-12);
  EXPECT_GT(share_of_hook(beyond, tilt), 1);
  EXPECT_DOUBLE_EQ(tilt_factor(beyond, tilt), 2);
  // Lift points so unlike in height that the formula's span has turned over.
  EXPECT_DOUBLE_EQ(tilt_factor({1.6, 12, 1.6, 1}, tilt), 2);
  EXPECT_DOUBLE_EQ(tilt_factor({0.3, 2, 0.6, 2}, {}), 1.5);
}

// Two slings each, 3 m apart along the line between the hooks and 6 m below them, hold the load to
// the hooks: by statics of one body that hangs from both hooks, 10 m apart and 8 m above its
// centre, P/W = 1/2 + 8 tan t / 10. From 6 tan t = 1.5 m on one sling of each is slack, and those
// left end 10 m apart, 2 m above the centre: P/W = (6.5 + 2 tan t) / 10.
TEST(TwoHooks, TurnAboutHooksBelowWhichSlingsSpread) {
  const SpreadOfHook slings{6, 1.5, 1.5};
  const TwoHooks hooks{5, 2, 5, 2, 0, 0, slings, slings};
  EXPECT_DOUBLE_EQ(share_of_hook(hooks, 0), 0.5);
  for (const double tilt : {-0.2, -0.05, 0.05, 0.2})
    EXPECT_NEAR(share_of_hook(hooks, tilt), 0.5 + 0.8 * std::tan(tilt), 1e-14);
  EXPECT_NEAR(share_of_hook(hooks, 0.3), 0.65 + 0.2 * std::tan(0.3), 1e-14);
  // Slings that spread across that line leave the load to turn about its lift points.
  const TwoHooks across{5, 2, 5, 2, 0, 0, {6, 0, 0}, {6, 0, 0}};
  EXPECT_NEAR(share_of_hook(across, 0.05), 0.5 + 0.2 * std::tan(0.05), 1e-14);
}

double factor_of(const std::string& material, double environment_share) {
  const StandardRules rules = shipped_rules("nd-0027");
  return sling_factor(*rules.sling, {material, "inspected", "resin_socket", {}, environment_share})
      .factor;
}

// 0027/ND 7.3.1, 7.4.3: certified as-new steel stays at the floor; other slings gain.
TEST(SlingFactor, IsThatOfTheGuideline) {
  const double half_a_digit = 0.5e-2;
  EXPECT_DOUBLE_EQ(factor_of("steel_as_new", 0), 2.3);
  EXPECT_DOUBLE_EQ(factor_of("steel_as_new", 0.15), 2.3);
  EXPECT_NEAR(factor_of("steel", 0), 2.54, half_a_digit + 1e-12);
  EXPECT_NEAR(factor_of("steel", 0.15), 2.36, half_a_digit);
  EXPECT_NEAR(factor_of("HMPE", 0), 3.38, half_a_digit);
  EXPECT_NEAR(factor_of("HMPE", 0.15), 3.15, half_a_digit);
  EXPECT_NEAR(factor_of("HMPE", 1.0 / 3), 2.86, half_a_digit);
}

// 7.4.3: beyond a third of environment 1 + 0.3 E/T is the larger of both and the factor rises again
// to the whole 1.3: 1.15 x 1.3 x 2 at a half.
TEST(SlingFactor, RisesAgainWhereTheEnvironmentGoverns) {
  EXPECT_NEAR(factor_of("HMPE", 0.5), 2.99, 1e-12);
  EXPECT_NEAR(factor_of("HMPE", 1), 3.38, 1e-12);
}

TEST(SlingFactor, TakesTheSharperOfBendingAndTermination) {
  const StandardRules rules = shipped_rules("nd-0027");
  const SlingFactor spliced = sling_factor(*rules.sling, {"steel", "yard", "hand_splice", 4.0, 0});
  // 1.3 x 1.3 x 1.5 x 1.2 x 1/(1 - 0.5/2)
  EXPECT_NEAR(spliced.reduction, 4.0 / 3, 1e-14);
  EXPECT_NEAR(spliced.factor, 1.69 * 1.5 * 1.2 * 4 / 3, 1e-12);
  const SlingFactor straight = sling_factor(*rules.sling, {"steel", "yard", "hand_splice", 9.0, 0});
  EXPECT_DOUBLE_EQ(straight.reduction, 1.25);
  EXPECT_THROW(sling_factor(*rules.sling, {"string", "yard", "hand_splice", {}, 0}),
               std::out_of_range);
}

// 0027/ND table 7-1.
TEST(SlingFactor, BendsByTheTable) {
  const std::pair<double, double> rows[]{{1.0, 2.00}, {1.5, 1.69}, {2.0, 1.55}, {3.0, 1.41},
                                         {4.0, 1.33}, {5.0, 1.29}, {6.0, 1.26}, {7.0, 1.23}};
  for (const auto& [ratio, factor] : rows)
    EXPECT_NEAR(bending_factor(0.5, ratio), factor, 0.5e-2) << ratio;
  EXPECT_NEAR(bend_efficiency(0.4, 0.1), 0.75, 1e-14);
  EXPECT_NEAR(bend_efficiency(0.1, 0.1), 0.5, 1e-14);
}

// EN 1991-3, table 2.5, at 0.2 m/s.
TEST(HoistingClass, GivesTheFactorOfItsSpeed) {
  const StandardRules rules = shipped_rules("en-13001");
  const std::pair<const char*, double> classes[]{
      {"HC1", 1.084}, {"HC2", 1.168}, {"HC3", 1.252}, {"HC4", 1.336}};
  for (const auto& [name, factor] : classes)
    EXPECT_NEAR(find_by_name(rules.hoisting_classes, name)->at(0.2), factor, 1e-12) << name;
}

// 0027/ND table 5-1.
TEST(Amplification, FollowsTheTable) {
  const StandardRules rules = shipped_rules("nd-0027");
  const auto at = [&](const char* setting, double tonnes) {
    const double load = tonnes * newton_per_tonne;
    return find_by_name(rules.dynamic_amplification, setting)->row_of(load).at(load);
  };
  EXPECT_DOUBLE_EQ(at("onshore", 60), 1.10);
  EXPECT_DOUBLE_EQ(at("onshore", 300), 1.05);
  EXPECT_DOUBLE_EQ(at("onshore", 900), 1.05);
  EXPECT_DOUBLE_EQ(at("onshore", 3800), 1.03);
  EXPECT_DOUBLE_EQ(at("inshore", 64), 1.07 + 0.05 * 1.25);
  EXPECT_DOUBLE_EQ(at("inshore", 900), 1.10);
  EXPECT_DOUBLE_EQ(at("inshore", 3800), 1.05);
  EXPECT_DOUBLE_EQ(at("offshore", 25), 1.5);
  EXPECT_DOUBLE_EQ(at("offshore", 101), 1.25);
  EXPECT_DOUBLE_EQ(at("offshore", 1001), 1.15);
}

// EN 1993-1-8, 3.13, by hand for a lug of 300 mm radius, plates of 80 and twice 35 mm (220 mm),
// hole 145, pin 140, yield 355 MPa, 2 MN: F/(2 T F_y) = 18.78 mm; the cheek plates' edge is 147.5
// mm.
TEST(PinPlate, IsThatOfTheEurocode) {
  structure::PadeyeFormulaInput input;
  input.geometry = {0.300, 0.080, 0.145, 0.140, 0.220, 0.035, 0.55, 0.6, 0.6};
  input.material.yield_stress = 355e6;
  const auto formulas = structure::padeye_en_1993_1_8(input, {0, 2e6, 0});
  ASSERT_EQ(formulas.size(), 3U);
  EXPECT_NEAR(formulas[0].limit, 0.115446, 1e-6);
  EXPECT_NEAR(formulas[0].demand, 0.1475, 1e-12);
  EXPECT_NEAR(formulas[0].utilisation, 0.78268, 1e-5);
  EXPECT_NEAR(formulas[1].limit, 0.067112, 1e-6);
  EXPECT_NEAR(formulas[2].limit, 11.1825e6, 1);
  EXPECT_NEAR(formulas[2].utilisation, 0.178851, 1e-6);
}

// EN 1993-1-8, table 3.10 and 3.13.2(3), by hand for the same lug and 2 MN in service: 0.6 x 150 mm
// x 140 mm x 355 MPa = 4.473 MN; 0.591 sqrt(210 GPa x 2 MN x 5 mm / (140 mm)^2 / 150 mm) = 499.486
// MPa against 2.5 x 355 MPa.
TEST(PinPlate, HasAReplaceablePinByTheEurocode) {
  structure::PadeyeFormulaInput input;
  input.geometry = {0.300, 0.080, 0.145, 0.140, 0.220, 0.035, 0.55, 0.6, 0.6};
  input.material.youngs_modulus = 210e9;
  input.material.yield_stress = 355e6;
  const auto formulas = structure::padeye_en_1993_1_8_replaceable(input, {0, 2e6, 0});
  ASSERT_EQ(formulas.size(), 2U);
  EXPECT_NEAR(formulas[0].limit, 4.473e6, 1);
  EXPECT_NEAR(formulas[0].utilisation, 0.447127, 1e-6);
  EXPECT_NEAR(formulas[1].demand, 499.486e6, 1e3);
  EXPECT_NEAR(formulas[1].utilisation, 0.562801, 2e-6);
}

}  // namespace
}  // namespace blocklift::pipeline
