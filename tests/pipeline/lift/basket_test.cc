// A box in two baskets, each round a bar from one hook and back: statics by hand, stress without a
// lug that is pulled at.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/measures/measure.h"
#include "tests/pipeline/lift/over_edges.h"

namespace blocklift::pipeline {
namespace {

using test::OverEdges;

constexpr double EA = 200e6, L0 = 4.6, off = 0.1, half_weight = 5e3 * 9.81;

// A hook at the height h over both edges of a bar, 0.1 m to either side: 2 T h / leg = W / 2.
struct BasketByHand {
  explicit BasketByHand(double h)
      : leg(std::hypot(h, off)),
        tension(EA / L0 * (2 * leg + 2 * off - L0)),
        lift(2 * tension * h / leg),
        angle(std::atan2(h, off)) {}
  static BasketByHand at_rest() {
    double low = 2.1, high = 2.4;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      (BasketByHand(middle).lift < half_weight ? low : high) = middle;
    }
    return BasketByHand(low);
  }
  double leg, tension, lift, angle;
};

TEST(Basket, HangsAsByHand) {
  const OverEdges lift(test::basket_lift());
  const BasketByHand hand = BasketByHand::at_rest();
  const dynamics::History& history = lift.run->static_history;
  for (const std::size_t sling : {0U, 1U}) {
    const dynamics::RopeHistory& rope = lift.rope(history, sling);
    EXPECT_NEAR(rope.tension[0], hand.tension, 1e-6 * hand.tension);
    EXPECT_NEAR(rope.elongation[0], 2 * hand.leg + 2 * off - L0, 1e-8);
    for (const std::size_t edge : {0U, 1U}) {
      EXPECT_NEAR(rope.edges[edge].wrap[0], hand.angle, 1e-6);
      EXPECT_NEAR(rope.edges[edge].force(0, 2), 0.5 * half_weight, 1e-5 * half_weight);
    }
  }
  EXPECT_NEAR(load_on_slings(lift.run->model, history)[0], 2 * half_weight, 1e-6 * half_weight);
  const std::vector<LiftMeasure> measures = find_measures(lift.lift_case, *lift.run);
  const auto angle = std::find_if(measures.begin(), measures.end(), [](const LiftMeasure& one) {
    return one.name() == "R1: sling angle";
  });
  ASSERT_NE(angle, measures.end());
  EXPECT_NEAR(angle->at_rest[0], hand.angle, 1e-6);
}

// All that bears the block are its edges: balance, names, a verdict.
TEST(Basket, LoadsTheBlock) {
  for (const bool rubs : {false, true}) {
    test::SampleLift files = test::basket_lift();
    if (rubs)
      for (const char* side : {"aft_out", "aft_in", "fore_in", "fore_out"})
        files.block = test::with(files.block, std::string(side) + ": {",
                                 std::string(side) + ": {friction: 0.3, ");
    const test::TemporaryFolder folder;
    files.write(folder);
    LiftCase lift_case = read_lift_case(".");
    lift_case.structure.element_degree = 2;
    lift_case.structure.accuracy = 1;
    const Assessment assessment = assess(std::move(lift_case), OverEdges::nothing);
    const BlockRun& block = assessment.block;
    ASSERT_TRUE(block.edges);
    EXPECT_LT(block.history->dynamic_state.largest_force_residual, 1e-10);
    EXPECT_LT(block.history->dynamic_state.largest_moment_residual, 1e-10);
    EXPECT_EQ(block.history->ropes, (std::vector<std::string>{"R1", "R2"}));
    ASSERT_EQ(block.assessment.simultaneous_by_rope.size(), 2U);
    EXPECT_EQ(block.assessment.simultaneous_by_rope[1].static_state.rope, "R2");
    const std::string& governs = block.history->dynamic_state.checked_von_mises.rope;
    EXPECT_TRUE(governs == "R1" || governs == "R2") << governs;
    for (const LoadComparison& loads : block.assessment.simultaneous_by_rope)
      EXPECT_LT(loads.dynamic_state.result.balance.reaction_over_weight, 1e-7);
    EXPECT_GT(block.history->dynamic_state.checked_von_mises.at.value, 1e6);
  }
}

}  // namespace
}  // namespace blocklift::pipeline
