// Whole chains, worked by hand.

#include "pipeline/standards/standard_assessment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/standards/shipped_rules.h"
#include "tests/pipeline/standards/worked_chains.h"

namespace blocklift::pipeline {
namespace {

using test::by_nd_0027;
using test::called;
using test::chain_of;
using test::shipped_rules;
using test::step_of;
using test::two_slings;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// 400 kN x 1.10 (weight B) x 1.10 (centre) x 1.05 (DAF of 112 t ashore) x 1.25 (skew) = 635.25 kN;
// in motion 400 x 1.10 x 1.10 x 460/400 x 1.25 = 695.75 kN; 2,000 kN / (1.3 x 1.3 x 1.5) = 788.95
// kN.
TEST(StandardAssessment, WorksASlingStepByStep) {
  const StandardAssessment result = assess_standard(by_nd_0027(), two_slings());
  const Chain& sling = chain_of(result, "sling R1");
  EXPECT_NEAR(sling.standard, 635.25e3, 1e-6);
  EXPECT_NEAR(sling.simulated, 695.75e3, 1e-6);
  EXPECT_NEAR(*sling.limit, 2000e3 / 2.535, 1e-6);
  EXPECT_NEAR(sling.standard_utilisation(), 0.805179, 1e-6);
  EXPECT_NEAR(sling.simulated_utilisation(), 0.881863, 1e-6);
  for (const ChainStep& step : sling.steps)
    EXPECT_TRUE(step.kind != ChainStep::Kind::factor || !step.clause.empty()) << step.name;
}

// As the sling, times 1.30 (0027/ND, table 11-1: "lift points including spreader bars"): 825.825 kN
// and 904.475 kN of 1,500 kN / 1.5.
TEST(StandardAssessment, HoldsASpreaderAsALiftPoint) {
  LiftFacts facts = two_slings();
  facts.spreader_factor = 1.5;
  facts.spreaders.push_back({"B1", facts.slings[0].load, {}, 2, false, 1500e3, 1500e3});
  const StandardAssessment result = assess_standard(by_nd_0027(), facts);
  const Chain& spreader = chain_of(result, "spreader B1");
  EXPECT_NEAR(spreader.standard, 825.825e3, 1e-6);
  EXPECT_NEAR(spreader.simulated, 904.475e3, 1e-6);
  EXPECT_NEAR(spreader.standard_utilisation(), 0.825825, 1e-9);
  EXPECT_NEAR(spreader.simulated_utilisation(), 0.904475, 1e-9);
}

// 1,000 kN below the block x 1.10 (weight B) + 20 kN of rigging = 1,120 kN, which is the static hook
// load of 0027/ND; x 1.05 (DAF of 112 t ashore), and the block of 30 kN with it. A centre of mass
// elsewhere brings the one hook nothing, where it brings each of two 1.10 times its share.
TEST(StandardAssessment, WhatBearsAllTakesNoFactorOnTheCentre) {
  LiftFacts facts = two_slings();
  const auto load_of_hook = [&] {
    return chain_of(assess_standard(by_nd_0027(), facts), "hook C1.main").standard;
  };
  const double shared = load_of_hook();
  facts.hooks[0].computed.bears_all = true;
  const double alone = load_of_hook();
  EXPECT_NEAR(alone, (1000e3 * 1.10 + 20e3 + 30e3) * 1.05, 1e-6);
  EXPECT_NEAR(shared - alone, 1000e3 * 1.10 * 0.10 * 1.05, 1e-6);
}

TEST(StandardAssessment, EveryColumnIsTheProductOfItsSteps) {
  const StandardAssessment result = assess_standard(by_nd_0027(), two_slings());
  for (const Chain& chain : result.chains) {
    double standard = 0, simulated = 0;
    for (const ChainStep& step : chain.steps) {
      if (step.kind == ChainStep::Kind::load) {
        standard += *step.standard;
        simulated += *step.simulated;
      } else if (step.kind == ChainStep::Kind::factor) {
        standard *= step.standard.value_or(1);
        simulated *= step.simulated.value_or(1);
      }
    }
    EXPECT_NEAR(standard, chain.standard, 1e-9 * chain.standard) << chain.object;
    EXPECT_NEAR(simulated, chain.simulated, 1e-9 * chain.simulated) << chain.object;
  }
}

// ((1,030 - 30) x 1.1 x 1.1 + 20 + 30) x 1.05 = 1,323 kN of 1,500.
TEST(StandardAssessment, AddsRiggingAndHookBlockToAHook) {
  const StandardAssessment result = assess_standard(by_nd_0027(), two_slings());
  const Chain& hook = chain_of(result, "hook C1.main");
  EXPECT_NEAR(hook.standard, 1323e3, 1e-6);
  EXPECT_NEAR(hook.simulated, 1260e3 * 1.04, 1e-6);
  EXPECT_NEAR(hook.utilisation(), 0.882, 1e-9);
}

TEST(StandardAssessment, TakesTheHoistingFactorWhereTheRulesHaveNoOther) {
  given::Standard standard;
  standard.rules = shipped_rules("en-13001");
  standard.hoisting_class = called("HC2");
  const StandardAssessment result = assess_standard(standard, two_slings());
  // (1,000 + 20 + 30) x (1.10 + 0.34 x 0.2)
  EXPECT_NEAR(chain_of(result, "hook C1.main").standard, 1050e3 * 1.168, 1e-6);
  EXPECT_FALSE(chain_of(result, "sling R1").has_limit());
}

TEST(StandardAssessment, SaysWhatTheRulesDoNotCover) {
  LiftFacts facts = two_slings();
  given::Standard standard = by_nd_0027();
  // 1.15 in motion is more than 1.05, and less than 1.05 x 1.25.
  EXPECT_THAT(assess_standard(standard, facts).notes,
              Contains(HasSubstr("only their skew factor, which stands for sling lengths, does: R1 "
                                 "1.150 > 1.050")));
  standard.skew = called("determinate");
  EXPECT_THAT(assess_standard(standard, facts).notes, Contains(HasSubstr("R1 1.150 > 1.050.")));
  facts.slings[0].material = "steel_as_new";
  EXPECT_THAT(assess_standard(standard, facts).notes,
              Contains(HasSubstr("The safety factor of R1 is the floor of the rules")));
}

TEST(StandardAssessment, LowersTheLoadFactorForWavesAlone) {
  LiftFacts facts = two_slings();
  const given::Standard standard = by_nd_0027();
  const Chain ashore = chain_of(assess_standard(standard, facts), "sling R1");
  EXPECT_DOUBLE_EQ(*ashore.simulated_limit, *ashore.limit);
  facts.has_environment = true;
  const Chain afloat = chain_of(assess_standard(standard, facts), "sling R1");
  const double share = 1 - 400.0 / 460;
  EXPECT_NEAR(*afloat.simulated_limit, 2000e3 / ((1.3 - 0.6 * share) * 1.3 * 1.5), 1e-6);
  EXPECT_DOUBLE_EQ(*afloat.limit, *ashore.limit);
}

TEST(StandardAssessment, HoldsShacklesAgainstStaticAndDynamicLoad) {
  given::Standard standard = by_nd_0027();
  given::Shackle shackle;
  shackle.name = called("L1");
  shackle.working_load = 650e3;
  shackle.breaking_load = 3900e3;
  standard.shackles.push_back(shackle);
  const StandardAssessment result = assess_standard(standard, two_slings());
  // 400 x 1.1 x 1.1 x 1.25 = 605 of 650 kN at rest; 635.25 of min(650 x 1.05, 3,900 / 3) in motion.
  EXPECT_NEAR(chain_of(result, "shackle L1 at rest").standard_utilisation(), 605.0 / 650, 1e-9);
  EXPECT_NEAR(*chain_of(result, "shackle L1").limit, 682.5e3, 1e-6);
}

/// Two slings at L1 whose forces of 300 and 400 kN meet at a right angle: 500 kN.
LiftFacts two_slings_at_a_lug(const ComputedFactors& first, const ComputedFactors& second) {
  LiftFacts facts = two_slings();
  facts.pulls = {{"L1",
                  {500e3, 550e3, 10, 12, 1.04, 1.1 / 1.04},
                  {{"R1", first, 2, {0, 300e3, 0}}, {"R2", second, 2, {0, 0, 400e3}}}}};
  return facts;
}

ComputedFactors with_skew(double skew) {
  ComputedFactors factors;
  factors.skew = skew;
  return factors;
}

given::Standard with_shackle_at_l1() {
  given::Standard standard = by_nd_0027();
  given::Shackle shackle;
  shackle.name = called("L1");
  shackle.working_load = 1000e3;
  shackle.breaking_load = 5000e3;
  standard.shackles.push_back(shackle);
  return standard;
}

// 500 kN x 1.10 x 1.10 x 1.25 = 756.25 kN at rest by the standard, whose skew is the same for both.
// Computed skew of 1.1 and 1.5: sqrt((1.1 x 300)^2 + (1.5 x 400)^2) = 684.763 kN, x 1.10 x 1.10.
TEST(StandardAssessment, SumsTheSlingsOfALugWithTheirOwnFactors) {
  const StandardAssessment result =
      assess_standard(with_shackle_at_l1(), two_slings_at_a_lug(with_skew(1.1), with_skew(1.5)));
  EXPECT_EQ(std::count_if(result.chains.begin(), result.chains.end(),
                          [](const Chain& chain) { return chain.kind == "shackle"; }),
            2);
  const Chain& at_rest = chain_of(result, "shackle L1 at rest");
  EXPECT_NEAR(at_rest.standard, 756.25e3, 1e-6);
  EXPECT_NEAR(at_rest.simulated, 1.21 * std::hypot(330e3, 600e3), 1e-6);
  const ChainStep& skew = step_of(at_rest, "skew of sling lengths");
  EXPECT_NEAR(*skew.simulated, std::hypot(330.0, 600.0) / 500, 1e-12);
  EXPECT_THAT(skew.formula, HasSubstr("of the sum of R1 1.250, R2 1.500; R2: computed"));
  const Chain& in_motion = chain_of(result, "shackle L1");
  EXPECT_NEAR(in_motion.standard, 1.05 * 756.25e3, 1e-6);
  EXPECT_NEAR(in_motion.simulated, 1.1 * 1.21 * std::hypot(330e3, 600e3), 1e-6);
}

// The order in which the case names them does not matter, nor does one sling that bears nothing.
TEST(StandardAssessment, TakesAllSlingsOfALugAlike) {
  const given::Standard standard = with_shackle_at_l1();
  LiftFacts facts = two_slings_at_a_lug(with_skew(1.1), with_skew(1.5));
  const double sum = chain_of(assess_standard(standard, facts), "shackle L1").simulated;
  std::swap(facts.pulls[0].slings[0], facts.pulls[0].slings[1]);
  EXPECT_NEAR(chain_of(assess_standard(standard, facts), "shackle L1").simulated, sum, 1e-6);
  facts.pulls[0].slings.push_back({"R3", with_skew(9), 2, {0, 0, 0}});
  EXPECT_NEAR(chain_of(assess_standard(standard, facts), "shackle L1").simulated, sum, 1e-6);
}

// A sling that pulls down by 100 kN at a lug that hangs on 600 kN eases it: that it bears 3 times
// as much is no help. The other bears 1.1 (centre) x 1.2 (skew) times as much: 792 - 100 kN, and
// 1.1 times that by the weight.
TEST(StandardAssessment, DoesNotCountOnASlingThatEasesTheLug) {
  given::Standard standard = with_shackle_at_l1();
  standard.skew.reset();
  LiftFacts facts = two_slings_at_a_lug(with_skew(1.2), with_skew(3));
  facts.pulls[0].slings[0].force = {0, 0, 600e3};
  facts.pulls[0].slings[1].force = {0, 0, -100e3};
  EXPECT_NEAR(chain_of(assess_standard(standard, facts), "shackle L1 at rest").simulated,
              1.1 * 692e3, 1e-6);
}

/// The two slings with both legs at the hook, 35 degrees to the plumb.
LiftFacts two_legs() {
  LiftFacts facts = two_slings();
  SlingFacts other = facts.slings[0];
  other.name = "R2";
  other.lug = "L2";
  other.load.at_rest = 820e3;
  facts.slings.push_back(other);
  for (SlingFacts& sling : facts.slings) {
    sling.is_at_hook = true;
    sling.angle = 0.6;
  }
  return facts;
}

// (1,030 - 30) x 1.1 x 1.1 + 20 = 1,230 kN of 1,300 at rest; x 1.05 = 1,291.5 by the standard and
// x 1.04 by the simulation of 1,300 x 1.05 in motion. Legs of 400 and 820 kN: 1,000 over 820.
TEST(StandardAssessment, HoldsAMasterLinkAgainstAllItsLegs) {
  given::Standard standard = by_nd_0027();
  standard.master_links.push_back({called("C1.main"), 1300e3, 6500e3, 100});
  const StandardAssessment result = assess_standard(standard, two_legs());
  const Chain& at_rest = chain_of(result, "master link C1.main at rest");
  EXPECT_NEAR(at_rest.standard, 1230e3, 1e-6);
  EXPECT_NEAR(at_rest.utilisation(), 1230.0 / 1300, 1e-12);
  const ChainStep& legs = step_of(at_rest, "load factor of the legs");
  EXPECT_DOUBLE_EQ(*legs.standard, 1.4);
  EXPECT_NEAR(*legs.simulated, 1000.0 / 820, 1e-12);
  EXPECT_THAT(legs.formula, HasSubstr("2 legs, up to 34.4 deg to the plumb"));
  const Chain& in_motion = chain_of(result, "master link C1.main");
  EXPECT_NEAR(in_motion.standard, 1291.5e3, 1e-6);
  EXPECT_NEAR(in_motion.simulated, 1230e3 * 1.04, 1e-6);
  EXPECT_NEAR(*in_motion.limit, 1365e3, 1e-6);
}

// Rules that have accessories hold the dynamic load against the breaking load, too: 6,500 / 5.
TEST(StandardAssessment, HoldsAccessoriesAgainstTheRulesOfTheirOwn) {
  given::Standard standard = by_nd_0027();
  standard.rules.accessory = ShackleRules{{1, "own 1"}, {5, "own 2"}};
  standard.master_links.push_back({called("C1.main"), 1300e3, 6500e3, 0});
  const Chain chain = chain_of(assess_standard(standard, two_legs()), "master link C1.main");
  EXPECT_NEAR(*chain.limit, 1300e3, 1e-6);
  EXPECT_EQ(chain.limit_clause, "own 2");
}

// EN 818-4 by angle to the plumb and number of legs; none beyond 60 degrees.
TEST(StandardAssessment, TellsTheLoadFactorOfLegsByAngleAndNumber) {
  given::Standard standard = by_nd_0027();
  standard.master_links.push_back({called("C1.main"), 1300e3, 6500e3, 0});
  const auto factor = [&](std::size_t legs, double angle) {
    LiftFacts facts = two_legs();
    while (facts.slings.size() < legs) facts.slings.push_back(facts.slings[0]);
    facts.slings[0].angle = angle;
    const Chain chain = chain_of(assess_standard(standard, facts), "master link C1.main at rest");
    return step_of(chain, "load factor of the legs").standard;
  };
  EXPECT_DOUBLE_EQ(*factor(2, 0.9), 1.0);
  EXPECT_DOUBLE_EQ(*factor(3, 0.7), 2.1);
  EXPECT_DOUBLE_EQ(*factor(4, 1.0), 1.5);
  EXPECT_FALSE(factor(4, 1.1));
}

// Twice the sling's 605 kN at rest of 1,300; twice 635.25 in motion of 1,300 x 1.05. Round a tread
// of 300 mm a sling of 75 mm has D/d 4: 1 / (1 - 0.5 / 2) = 1.333 in place of the socket's 1.
TEST(StandardAssessment, BendsASlingOverItsSheave) {
  given::Standard standard = by_nd_0027();
  standard.sheaves.push_back({called("R1"), 1300e3, 6500e3, 0.3});
  LiftFacts facts = two_slings();
  facts.slings[0].diameter = 0.075;
  const StandardAssessment result = assess_standard(standard, facts);
  EXPECT_NEAR(chain_of(result, "sheave R1 at rest").utilisation(), 1210.0 / 1300, 1e-12);
  EXPECT_NEAR(chain_of(result, "sheave R1").standard_utilisation(), 1270.5 / 1365, 1e-12);
  EXPECT_NEAR(*chain_of(result, "sling R1").limit, 2000e3 / (2.535 * 4 / 3), 1e-6);
  standard.bend_diameter = 0.168750;  // sharper, D/d 2.25, elsewhere along the sling
  EXPECT_NEAR(*chain_of(assess_standard(standard, facts), "sling R1").limit, 2000e3 / (2.535 * 1.5),
              1e-6);
}

// A chart that allows 1,287.5 kN where its share is largest at rest (1,030 kN x 0.8) and 1,190.2 in
// motion takes the place of the hoist's 1,500; of the crane, with its reserve of a fifth, too.
TEST(StandardAssessment, TakesTheLoadChartAtTheRadius) {
  given::Standard standard = by_nd_0027();
  standard.rules.add(shipped_rules("queensland-tandem"));
  LiftFacts facts = two_slings();
  facts.hooks[0].chart = ChartFacts{0.8, 0.9, 22.5, "x 0.9 for wind of 12 m/s (maker)"};
  CraneFacts crane;
  crane.name = "C1";
  crane.load = facts.hooks[0].load;
  crane.hook_blocks = 30e3;
  crane.chart = facts.hooks[0].chart;
  facts.cranes = {crane, crane};
  facts.cranes[1].name = "C2";
  facts.cranes[1].chart.reset();
  facts.cranes[1].capacity = 1500e3;
  const StandardAssessment result = assess_standard(standard, facts);
  const Chain& hook = chain_of(result, "hook C1.main");
  EXPECT_NEAR(*hook.limit, 1287.5e3, 1e-6);
  EXPECT_NEAR(*hook.simulated_limit, 1071.2e3 / 0.9, 1e-6);
  EXPECT_EQ(hook.limit_text, "load chart at 22.50 m, x 0.9 for wind of 12 m/s (maker)");
  EXPECT_NEAR(*chain_of(result, "crane C1").limit, 0.8 * 1287.5e3, 1e-6);
  EXPECT_NEAR(*chain_of(result, "crane C2").limit, 1200e3, 1e-6);
  EXPECT_THAT(chain_of(result, "crane C2").limit_text, HasSubstr("capacity 1500.0 kN"));
  // A chart that allows more than the hoist does not count.
  facts.hooks[0].chart = ChartFacts{0.5, 0.5, 22.5, {}};
  EXPECT_NEAR(*chain_of(assess_standard(standard, facts), "hook C1.main").limit, 1500e3, 1e-6);
}

// A box that could not be worked does not take the rules' factor away.
TEST(StandardAssessment, TakesTheRulesFactorWhereTheBoxIsNotWorked) {
  given::Standard standard = by_nd_0027();
  standard.centre_box = Vector3(0.1, 0.1, 0.1);
  const Chain by_rules = chain_of(assess_standard(standard, two_slings()), "sling R1");
  EXPECT_NEAR(by_rules.standard, 635.25e3, 1e-6);
  LiftFacts facts = two_slings();
  facts.slings[0].computed.centre_box = 1.02;
  const Chain by_box = chain_of(assess_standard(standard, facts), "sling R1");
  EXPECT_NEAR(by_box.standard, 635.25e3 / 1.10 * 1.02, 1e-6);
}

// A shackle that is pulled 3 degrees out of its plane at rest and 30 in motion bears all of its
// working load there and 70 % here; one at a lug without a padeye is said not to be looked at.
TEST(StandardAssessment, DeratesShacklesUnderSideLoads) {
  given::Standard standard = by_nd_0027();
  standard.rules.add(shipped_rules("shackle-side-load"));
  given::Shackle shackle;
  shackle.name = called("L1");
  shackle.working_load = 650e3;
  shackle.breaking_load = 3900e3;
  standard.shackles.push_back(shackle);
  LiftFacts facts = two_slings();
  Chain chain = chain_of(assess_standard(standard, facts), "shackle L1");
  EXPECT_NEAR(*chain.limit, 682.5e3, 1e-6);
  EXPECT_THAT(chain.steps.back().formula, HasSubstr("the lug has no padeye"));

  LugFacts lug;
  lug.name = "L1";
  lug.at_rest = 400e3 * structure::Vector3(0, std::cos(0.05), std::sin(0.05));
  lug.in_motion = 460e3 * structure::Vector3(0, 1, 0);
  lug.lateral = 0.5;  // 30 degrees
  lug.input.geometry = {0.3, 0.08, 0.145, 0.140, 0.22, 0.035, 0.55, 0.6, 0.6};
  lug.input.material = {"steel", 206e9, 0.3, 7850, 355e6};
  facts.lugs.push_back(lug);
  const StandardAssessment result = assess_standard(standard, facts);
  chain = chain_of(result, "shackle L1");
  EXPECT_NEAR(*chain.limit, 682.5e3, 1e-6);
  EXPECT_NEAR(*chain.simulated_limit, 0.7 * 682.5e3, 1e-6);
  EXPECT_NEAR(*chain_of(result, "shackle L1 at rest").limit, 650e3, 1e-6);
}

// ASME BTH-1 in US units (kip, in): N_d 2, t 1.25, a = b_e = 3, D_p 2.75, D_h 3, R 4.5, F_y 36,
// F_u 58; C_r taken 1 there: P_t 175.2, P_b 144.1, P_v 148.0 kip.
TEST(StandardAssessment, HoldsALugByTheFormulaeThatTheRulesName) {
  constexpr double inch = 0.0254, kip = 4448.2216, ksi = kip / (inch * inch);
  given::Standard standard;
  standard.rules = shipped_rules("asme-bth-1-a");
  LiftFacts facts;
  LugFacts lug;
  lug.name = "L1";
  lug.input.geometry = {4.5 * inch, 1.25 * inch, 3 * inch, 2.75 * inch, 0,
                        0,          8 * inch,    8 * inch, 8 * inch};
  lug.input.material.yield_stress = 36 * ksi;
  lug.input.tensile_strength = 58 * ksi;
  lug.pull.load = {70 * kip, 80 * kip, 0, 0, 1, 8.0 / 7};
  lug.at_rest = lug.in_motion = {0, 70 * kip, 0};
  facts.lugs.push_back(lug);
  const StandardAssessment result = assess_standard(standard, facts);
  const Chain& chain = chain_of(result, "lug L1");
  // Bearing governs: 1.25 F_y / N_d D_p t.
  const double bearing = 1.25 * 36 / 2 * 2.75 * 1.25;
  EXPECT_NEAR(chain.standard_utilisation(), 70 / bearing, 1e-9);
  EXPECT_NEAR(chain.simulated_utilisation(), 80 / bearing, 1e-9);
  lug.input.design_factor = 2;
  const structure::AsmePinPlate plate = structure::asme_pin_plate(lug.input);
  EXPECT_NEAR(plate.tension / plate.clearance_factor / kip, 175.2, 0.05);
  EXPECT_NEAR(plate.splitting / plate.clearance_factor / kip, 144.1, 0.05);
  EXPECT_NEAR(plate.shear / kip, 148.0, 0.05);
  given::Standard category_b = standard;
  category_b.rules = shipped_rules("asme-bth-1-b");
  EXPECT_NEAR(chain_of(assess_standard(category_b, facts), "lug L1").standard_utilisation(),
              1.5 * chain.standard_utilisation(), 1e-9);
}

TEST(StandardAssessment, HoldsBackAShareOfSeveralCranes) {
  given::Standard standard;
  standard.rules = shipped_rules("nd-0027");
  standard.rules.add(shipped_rules("queensland-tandem"));
  standard.weight_class = called("weighed");
  standard.setting = called("onshore");
  LiftFacts facts = two_slings();
  for (const char* name : {"C1", "C2", "C3"}) {
    CraneFacts crane;
    crane.name = name;
    crane.load = {500e3, 510e3, 0, 0, 1.02, 1};
    crane.capacity = 1000e3;
    facts.cranes.push_back(crane);
  }
  facts.slings.clear();
  const StandardAssessment result = assess_standard(standard, facts);
  EXPECT_NEAR(*chain_of(result, "crane C2").limit, 670e3, 1e-6);
  EXPECT_EQ(result.name, "0027/ND + Queensland code");
  EXPECT_THAT(chain_of(result, "crane C2").limit_clause, HasSubstr("Queensland code"));
}

}  // namespace
}  // namespace blocklift::pipeline
