// Chains of the structure's stresses, worked by hand.

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

// Stress at rest 100 MPa, by weight class 1.1, centre 1.1, 1.05 onshore, 1.2 on a diagonal by the
// rules, 1.3 as computed. The two slings' lugs have no box that could be worked.
TEST(StructureChains, SkewsTheStructure) {
  LiftFacts facts = two_slings();
  StressFacts stress;
  stress.name = stress.material = "S355";
  stress.at_rest = 100e6;
  stress.in_motion = 110e6;
  stress.yield = 355e6;
  stress.skew_by_rules = 1.2;
  stress.skew_computed = 1.3;
  facts.yield_factor = 1.5;
  facts.stresses = {stress};
  const StandardAssessment result = assess_standard(by_nd_0027(), facts);
  const Chain& chain = chain_of(result, "structure S355");
  EXPECT_NEAR(chain.standard, 100e6 * 1.1 * 1.1 * 1.05 * 1.2, 1);
  EXPECT_NEAR(chain.simulated, 110e6 * 1.1 * 1.1 * 1.3, 1);
}

// 0027/ND, table 5-1: rows by gross weight, formulae by static hook load. 92 t of class A weigh
// 96.6 t and their rigging 8 t: the row up to 100 t, 1.07 + 0.05 sqrt(100 / 104.6).
TEST(StructureChains, AmplificationGoesByWeightAndHookLoad) {
  given::Standard standard = by_nd_0027();
  standard.weight_class = called("A");
  standard.setting = called("inshore");
  LiftFacts facts = two_slings();
  facts.net_weight = 92 * newton_per_tonne;
  facts.rigging = 8 * newton_per_tonne;
  const StandardAssessment inshore = assess_standard(standard, facts);
  const Chain& lift = chain_of(inshore, "lift as a whole");
  EXPECT_NEAR(step_of(lift, "dynamic amplification").standard.value(),
              1.07 + 0.05 * std::sqrt(100 / 104.6), 1e-12);
  standard.setting = called("onshore");
  const StandardAssessment ashore = assess_standard(standard, facts);
  EXPECT_DOUBLE_EQ(
      step_of(chain_of(ashore, "lift as a whole"), "dynamic amplification").standard.value(), 1.10);
}

/// Two hooks with two slings each, 400 kN in each sling; the stress about L1 and elsewhere.
LiftFacts four_slings_on_two_hooks() {
  LiftFacts facts = two_slings();
  const SlingFacts sling = facts.slings[0];
  facts.slings.clear();
  for (int i = 1; i <= 4; ++i) {
    SlingFacts& one = facts.slings.emplace_back(sling);
    one.name = "R" + std::to_string(i);
    one.lug = "L" + std::to_string(i);
    one.hook = i < 3 ? "C1.main" : "C2.main";
    one.computed.two_hooks = i < 3 ? TwoHooks{12, 10, 13, 14} : TwoHooks{13, 14, 12, 10};
  }
  StressFacts stress;
  stress.name = stress.material = "S355";
  stress.at_rest = 100e6;
  stress.in_motion = 110e6;
  stress.yield = 355e6;
  facts.stresses = {stress, stress};
  facts.stresses[1].name = "about lug L1";
  facts.stresses[1].material.clear();
  facts.stresses[1].is_at_lug = true;
  facts.stresses[1].lug = "L1";
  return facts;
}

given::Standard by_nd_0027_on_two_hooks() {
  given::Standard standard = by_nd_0027();
  standard.skew = called("determinate");
  standard.tilt = called("same_vessel");
  return standard;
}

// Tilt of 3 degrees: 1.047654 on the first hook, 1.052498 on the second one,
// (10 sin 3 + 12 cos 3) / (25 cos 3 - 4 sin 3) / 0.48. A lug's surroundings take that of their own
// sling, as its load does, other places the larger one; centre 1.10 and yaw 1.05 everywhere,
// members about lugs 1.15 (0027/ND, table 11-1). Motion contains tilt and yaw.
TEST(StructureChains, TheStructureTakesCentreTiltAndYawOfItsSlings) {
  const StandardAssessment result =
      assess_standard(by_nd_0027_on_two_hooks(), four_slings_on_two_hooks());
  const double common = 100e6 * 1.1 * 1.1 * 1.05 * 1.05;
  const Chain& field = chain_of(result, "structure S355");
  EXPECT_NEAR(field.standard, common * 1.052498, 100);
  EXPECT_NEAR(field.simulated, 110e6 * 1.1 * 1.1, 1);
  EXPECT_THAT(step_of(field, "tilt").formula, HasSubstr("as R3: 3.00 degrees"));
  const Chain& lug = chain_of(result, "structure about lug L1");
  EXPECT_NEAR(lug.standard, common * 1.047654 * 1.15, 100);
  EXPECT_NEAR(lug.simulated, 110e6 * 1.1 * 1.1 * 1.15, 1);
  const Chain& sling = chain_of(result, "sling R1");
  for (const char* step : {"centre of mass", "tilt", "yaw"})
    EXPECT_EQ(step_of(lug, step).standard, step_of(sling, step).standard) << step;
}

// 0027/ND 5.4.2 is for two hooks of one crane, too, where the case need not name a tilt.
TEST(StructureChains, TellsThatHooksMayDifferInHeight) {
  const auto told = HasSubstr("two hooks and the case names no tilt");
  LiftFacts facts = two_slings();
  EXPECT_THAT(assess_standard(by_nd_0027(), facts).notes, Not(Contains(told)));
  facts.hooks.front().computed.two_hooks = TwoHooks{12, 10, 13, 14};
  EXPECT_THAT(assess_standard(by_nd_0027(), facts).notes, Contains(told));
  EXPECT_THAT(assess_standard(by_nd_0027_on_two_hooks(), facts).notes, Not(Contains(told)));
}

// With a box of the centre the largest growth counts: 1.08 of R4. R2 bears a tenth of the others
// and grows by half, which does not count, about its own lug neither. A sling to a spreader does
// not pull at the structure.
TEST(StructureChains, TheStructureTakesTheBoxOfSlingsThatBear) {
  given::Standard standard = by_nd_0027_on_two_hooks();
  standard.centre_box = Vector3(0.1, 0.1, 0.1);
  LiftFacts facts = four_slings_on_two_hooks();
  for (SlingFacts& sling : facts.slings) sling.computed.centre_box = 1.04;
  facts.slings[1].load.at_rest = 40e3;
  facts.slings[1].computed.centre_box = 1.5;
  facts.slings[3].computed.centre_box = 1.08;
  SlingFacts above = facts.slings[0];
  above.name = "R5";
  above.lug.clear();
  above.is_at_load = false;
  above.computed.centre_box = 1.3;
  facts.slings.push_back(above);
  const auto centre = [&](const char* object) {
    return *step_of(chain_of(assess_standard(standard, facts), object), "centre of mass").standard;
  };
  EXPECT_DOUBLE_EQ(centre("structure S355"), 1.08);
  EXPECT_DOUBLE_EQ(centre("structure about lug L1"), 1.04);
  facts.stresses[1].lug = "L2";
  EXPECT_DOUBLE_EQ(centre("structure about lug L1"), 1.08);
  // Without slings, as in a load table, the rules' factor stands and nothing is said of a hook.
  facts.slings.clear();
  EXPECT_DOUBLE_EQ(centre("structure S355"), 1.10);
}

// Class rules: 1.70 of the field's allowable in squares of 50 mm near corners, 1.50 beside welds.
TEST(StructureChains, AllowsMoreNearCorners) {
  given::Standard standard = by_nd_0027();
  standard.rules.add(shipped_rules("iacs-csr"));
  LiftFacts facts = two_slings();
  facts.yield_factor = 1.5;
  for (const structure::SquareSite site : structure::square_sites) {
    StressFacts stress;
    stress.name = structure::words_of(site);
    stress.at_rest = stress.in_motion = 100e6;
    stress.yield = 355e6;
    stress.site = site;
    facts.stresses.push_back(stress);
  }
  const StandardAssessment result = assess_standard(standard, facts);
  const auto chain = [&](const char* site) {
    return chain_of(result, std::string("structure ") + site);
  };
  EXPECT_NEAR(*chain("away from corners").limit, 355e6 / 1.5, 1);
  EXPECT_EQ(chain("away from corners").limit_clause, "checks.yield_factor");
  EXPECT_NEAR(*chain("at corners").limit, 1.7 * 355e6 / 1.5, 1);
  EXPECT_NEAR(*chain("at corners beside welds").limit, 1.5 * 355e6 / 1.5, 1);
  EXPECT_THAT(chain("at corners beside welds").limit_clause, HasSubstr("IACS CSR part 1"));
}

}  // namespace
}  // namespace blocklift::pipeline
