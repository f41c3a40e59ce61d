// A box in two crossing baskets from one hook and back: statics by hand, stress without a lug that
// is pulled at.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "pipeline/assessment/assess.h"
#include "pipeline/lift/parallel_baskets.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/measures/measure.h"
#include "tests/pipeline/lift/over_edges.h"

namespace blocklift::pipeline {
namespace {

using test::OverEdges;
using ::testing::HasSubstr;

constexpr double EA = 200e6, weight = 10e3 * 9.81;

// A sling from a hook at the height h over the edges, round two of them b to either side and back.
struct BasketByHand {
  BasketByHand(double h, double b, double unstretched)
      : leg(std::hypot(h, b)),
        stretch(2 * leg + 2 * b - unstretched),
        tension(EA / unstretched * stretch),
        lift(2 * tension * h / leg),
        angle(std::atan2(h, b)) {}
  double leg, stretch, tension, lift, angle;
};

// Two that cross: each bears what its stretch makes of it, 2 T h / leg, and both the weight.
std::array<BasketByHand, 2> at_rest_by_hand() {
  const auto both = [](double h) {
    return std::array{BasketByHand(h, 2, 12.94), BasketByHand(h, 1, 10.24)};
  };
  double low = 3.99, high = 4.2;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (low + high);
    const auto [along, across] = both(middle);
    (along.lift + across.lift < weight ? low : high) = middle;
  }
  return both(low);
}

TEST(Basket, HangsAsByHand) {
  const OverEdges lift(test::basket_lift());
  const std::array<BasketByHand, 2> by_hand = at_rest_by_hand();
  const dynamics::History& history = lift.run->static_history;
  for (const std::size_t sling : {0U, 1U}) {
    const BasketByHand& hand = by_hand[sling];
    const dynamics::RopeHistory& rope = lift.rope(history, sling);
    EXPECT_NEAR(rope.tension[0], hand.tension, 1e-6 * hand.tension);
    EXPECT_NEAR(rope.elongation[0], hand.stretch, 1e-8);
    for (const std::size_t edge : {0U, 1U}) {
      // It comes down outwards and goes on inwards, below the box.
      EXPECT_NEAR(rope.edges[edge].wrap[0], std::numbers::pi - hand.angle, 1e-6);
      EXPECT_NEAR(rope.edges[edge].force(0, 2), 0.5 * hand.lift, 1e-5 * weight);
    }
  }
  EXPECT_NEAR(load_on_slings(lift.run->model, history)[0], weight, 1e-6 * weight);
  const std::vector<LiftMeasure> measures = find_measures(lift.lift_case, *lift.run);
  const auto at_rest = [&](const std::string& name) {
    for (const LiftMeasure& measure : measures)
      if (measure.name() == name) return measure.at_rest[0];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(at_rest("R1: sling angle"), by_hand[0].angle, 1e-6);
  // The four places of touch are the middles of the sides, 2 m and 1 m off the centre.
  EXPECT_NEAR(at_rest("load: margin of the centre of mass"), 2 / std::sqrt(5), 1e-6);
  // In the motion friction holds the box in its slings.
  const dynamics::History& motion = lift.run->dynamic_history();
  for (const LiftMeasure& measure : measures)
    if (measure.name() == "load: tilt") {
      EXPECT_LT(measure.in_motion.maxCoeff(), 0.1);
    }
  double apart = 0;
  for (const dynamics::EdgeHistory& edge : lift.rope(motion, 0).edges)
    apart = std::max(apart, (edge.first_tension - edge.last_tension).cwiseAbs().maxCoeff());
  EXPECT_GT(apart, 100);
}

// All that bears the block are its edges: balance, names, a verdict.
TEST(Basket, LoadsTheBlock) {
  const test::TemporaryFolder folder;
  test::basket_lift().write(folder);
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

// Both baskets round the same two edges, and the centre of mass 0.1 m along these beside the hook.
test::SampleLift parallel_baskets() {
  test::SampleLift lift = test::basket_lift();
  lift.lift_case =
      test::with(lift.lift_case, "over: [port, starboard], model: ropes/tackle, length: 10.24 m",
                 "over: [aft, fore], model: ropes/tackle, length: 12.94 m");
  lift.block = test::with(lift.block, "[2 m, 0 m, 0.5 m]", "[2 m, 0.1 m, 0.5 m]");
  return lift;
}

TEST(Basket, ParallelOnesDoNotHoldALoadAlongTheirEdges) {
  const test::TemporaryFolder folder;
  parallel_baskets().write(folder);
  const std::string doubt = doubt_about_baskets(read_lift_case("."));
  EXPECT_THAT(doubt,
              HasSubstr("Nothing holds the load along its edges aft, fore: they run the same "
                        "way, and baskets R1, R2 over them are all that carries it."));
  try {
    const OverEdges lift(parallel_baskets());
    FAIL() << "the load hangs in baskets that slide";
  } catch (const dynamics::SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no static equilibrium was found"));
    EXPECT_THAT(error.what(), HasSubstr(doubt));
  }
}

// With its centre of mass below the hook it rests at the start, and slides when the crane travels.
TEST(Basket, ParallelOnesAreTheHintWhereTheLiftFailsLater) {
  test::SampleLift balanced = parallel_baskets();
  balanced.block = test::basket_lift().block;
  try {
    const OverEdges lift(balanced);
    FAIL() << "the load hangs in baskets that slide";
  } catch (const dynamics::SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the time integration failed at t = "));
    EXPECT_THAT(error.what(), HasSubstr("Nothing holds the load along its edges aft, fore"));
  }
}

TEST(Basket, NothingIsDoubtedWhereALoadIsHeldAlongItsEdges) {
  const auto doubt_of = [](const test::SampleLift& lift) {
    const test::TemporaryFolder folder;
    lift.write(folder);
    return doubt_about_baskets(read_lift_case("."));
  };
  EXPECT_EQ(doubt_of(test::basket_lift()), "");
  test::SampleLift with_lug = parallel_baskets();
  with_lug.lift_case =
      test::with(with_lug.lift_case, "operation:",
                 "  R3: {from: C1.right, to: L1, model: ropes/tackle, length: 3 m}\n"
                 "operation:");
  EXPECT_EQ(doubt_of(with_lug), "");
  test::SampleLift on_pads = parallel_baskets();
  on_pads.lift_case += "supports: {pad: {point: [2 m, 0 m, 0 m], stiffness: 100 MN/m}}\n";
  EXPECT_EQ(doubt_of(on_pads), "");
}

}  // namespace
}  // namespace blocklift::pipeline
