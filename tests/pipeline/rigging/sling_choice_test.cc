// Which sling and shackle the checks ask for, worked by hand from loads that are given.

#include "pipeline/rigging/sling_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/rigging/shackle_choice.h"
#include "tests/pipeline/rigging/sample_stock.h"
#include "tests/pipeline/sample_lift.h"
#include "tests/pipeline/standards/shipped_rules.h"

namespace blocklift::pipeline {
namespace {

using test::shackle_file;
using test::sling_file;
using test::TemporaryFolder;
using ::testing::HasSubstr;

Located<std::string> called(const std::string& name) { return {name, {}}; }

Stock stock_of(const std::vector<double>& breaking_loads,
               const std::vector<double>& working_loads = {}) {
  const TemporaryFolder folder;
  folder.write("slings.yaml", sling_file(breaking_loads));
  if (!working_loads.empty()) folder.write("shackles.yaml", shackle_file(working_loads));
  ModelLibrary library({BLOCKLIFT_MODELS});
  Diagnostics diagnostics;
  Stock stock = read_stock({"."}, {}, library, diagnostics);
  if (diagnostics.has_errors()) throw std::runtime_error(diagnostics.to_text());
  return stock;
}

LiftCase case_with_factor(double rope_safety_factor) {
  LiftCase lift_case;
  lift_case.checks.rope_safety_factor = rope_safety_factor;
  return lift_case;
}

LiftCase case_by_nd_0027() {
  LiftCase lift_case = case_with_factor(1);
  lift_case.standard.emplace();
  lift_case.standard->rules = test::shipped_rules("nd-0027");
  lift_case.standard->weight_class = called("B");
  lift_case.standard->setting = called("onshore");
  lift_case.standard->skew = called("matched");
  lift_case.standard->wear = called("inspected");
  return lift_case;
}

/// 1,000 kN on one hook by two slings; R1 has 400 kN at rest and 460 in motion.
LiftFacts facts_of_r1() {
  LiftFacts facts;
  facts.net_weight = 1000e3;
  facts.at_rest = 1000e3;
  facts.in_motion = 1040e3;
  SlingFacts sling;
  sling.name = "R1";
  sling.lug = "L1";
  sling.load = {400e3, 460e3, 10, 12, 1.04, 460.0 / 400 / 1.04};
  sling.slings_on_hook = 2;
  facts.slings.push_back(sling);
  facts.pulls.push_back({"L1", sling.load, {{"R1", {}, 2, {0, 0, 400e3}}}});
  return facts;
}

const SlingDemand r1{"R1", "L1", 400e3, 460e3};
const ShackleDemand at_l1{"L1", 400e3};

// 460 kN x 5 = 2,300 kN; 400 kN in line asks for a working load of 400 kN, which 2,000 kN have.
TEST(SlingChoiceTest, ByTheFactorOnTheLargestTension) {
  const LiftCase lift_case = case_with_factor(5);
  const SlingChecks checks(lift_case, {});
  const Stock stock = stock_of({1900, 2100, 2400, 2600});
  const ChosenSling chosen = choose_sling(stock, checks, r1);
  EXPECT_EQ(stock.slings[chosen.index].name(), "s2400");
  EXPECT_TRUE(chosen.pass());
  const Check& governing = *governing_check(chosen.checks);
  EXPECT_EQ(governing.name, "breaking load / 5");
  EXPECT_NEAR(governing.utilisation, 460.0 / 480, 1e-12);
}

// With a factor of 4 it is 1,840 kN; the working load of 2,100 / 5 = 420 kN bears the 400 kN.
TEST(SlingChoiceTest, ByTheWorkingLoadAtRest) {
  const LiftCase lift_case = case_with_factor(4);
  const SlingChecks checks(lift_case, {});
  const Stock stock = stock_of({1900, 2100, 2400, 2600});
  const ChosenSling chosen = choose_sling(stock, checks, r1);
  EXPECT_EQ(stock.slings[chosen.index].name(), "s2100");
  EXPECT_EQ(governing_check(chosen.checks)->name, "working load at rest, a fifth");
  EXPECT_NEAR(governing_check(chosen.checks)->utilisation, 400.0 / 420, 1e-12);
}

// The chain: 400 kN x 1.10 (weight B) x 1.10 (centre) x 460/400 x 1.25 (skew) = 695.75 kN in
// motion,
// times 1.3 x 1.3 x 1.5 = 1,763.7 kN. The working load is not asked.
TEST(SlingChoiceTest, ByTheChainOfAStandard) {
  const LiftCase lift_case = case_by_nd_0027();
  const SlingChecks checks(lift_case, facts_of_r1());
  const Stock stock = stock_of({1700, 1750, 1800, 1900});
  const ChosenSling chosen = choose_sling(stock, checks, r1);
  EXPECT_EQ(stock.slings[chosen.index].name(), "s1800");
  const Check& governing = *governing_check(chosen.checks);
  EXPECT_EQ(governing.name, "0027/ND, breaking load / 2.54, by the simulation");
  EXPECT_NEAR(governing.utilisation, 695.75 * 2.535 / 1800, 1e-9);
}

TEST(SlingChoiceTest, TakesTheNearestWhereNonePasses) {
  const LiftCase lift_case = case_with_factor(5);
  const SlingChecks checks(lift_case, {});
  const ChosenSling chosen = choose_sling(stock_of({1000, 2000}), checks, r1);
  EXPECT_EQ(chosen.index, 1U);
  EXPECT_FALSE(chosen.pass());
  EXPECT_NEAR(governing_check(chosen.checks)->utilisation, 460.0 / 400, 1e-12);
}

// Rules know materials and terminations by name; chain has none, so that no chain is chosen.
TEST(SlingChoiceTest, PassesOverWhatTheRulesDoNotKnow) {
  const LiftCase lift_case = case_by_nd_0027();
  const SlingChecks checks(lift_case, facts_of_r1());
  Stock stock = stock_of({1900, 2000});
  stock.slings[0].sling.rope.termination = called("knot");
  EXPECT_EQ(checks.obstacle(stock.slings[0], r1), "0027/ND has no termination \"knot\"");
  EXPECT_EQ(choose_sling(stock, checks, r1).index, 1U);
  stock.slings[1].sling.rope.material.reset();
  try {
    choose_sling(stock, checks, r1);
    FAIL() << "nothing can be chosen";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no sling of the stock can be held against the checks of "
                                        "R1"));
    EXPECT_THAT(error.what(), HasSubstr("s2000: it has no material, which 0027/ND needs"));
  }
}

// Round four diameters three quarters are left: 460 kN x 5 / 0.75 = 3,067 kN.
TEST(SlingChoiceTest, CountsTheBendOfTheRope) {
  LiftCase lift_case = case_with_factor(5);
  given::Rope rope;
  rope.name.value = "R1";
  rope.bend_diameter = Located<double>{0.4, {}};
  lift_case.ropes.push_back(rope);
  const SlingChecks checks(lift_case, {});
  Stock stock = stock_of({3000, 3100});
  EXPECT_THAT(checks.obstacle(stock.slings[0], r1), HasSubstr("no diameter"));
  for (SlingInStock& sling : stock.slings) sling.sling.rope.diameter = 0.1;
  const ChosenSling chosen = choose_sling(stock, checks, r1);
  EXPECT_EQ(stock.slings[chosen.index].name(), "s3100");
  EXPECT_NEAR(governing_check(chosen.checks)->utilisation, 460.0 * 5 / (0.75 * 3100), 1e-12);
  stock.slings[1].sling.rope.diameter = 0.5;
  EXPECT_THAT(checks.obstacle(stock.slings[1], r1), HasSubstr("less than its own diameter"));
}

TEST(SlingChoiceTest, PassesOverWhatIsBentTooSharply) {
  LiftCase lift_case = case_by_nd_0027();
  lift_case.standard->bend_diameter = 0.05;
  const SlingChecks checks(lift_case, facts_of_r1());
  Stock stock = stock_of({1900});
  EXPECT_THAT(checks.obstacle(stock.slings[0], r1), HasSubstr("no diameter"));
  stock.slings[0].sling.rope.diameter = 0.06;
  EXPECT_THAT(checks.obstacle(stock.slings[0], r1), HasSubstr("less than its own diameter"));
  stock.slings[0].sling.rope.diameter = 0.05;
  EXPECT_EQ(checks.obstacle(stock.slings[0], r1), "");
}

// 400 kN are 40.8 t.
TEST(ShackleChoiceTest, ByItsWorkingLoad) {
  const Stock stock = stock_of({1900}, {35, 42, 55});
  const ChosenShackle chosen = choose_shackle(stock, case_with_factor(5), {}, at_l1);
  ASSERT_TRUE(chosen.pass());
  EXPECT_EQ(stock.shackles[*chosen.index].name(), "b42");
  EXPECT_NEAR(governing_check(chosen.checks)->utilisation, 400e3 / (42e3 * 9.80665), 1e-12);
}

// 0027/ND: at rest 400 x 1.10 x 1.10 x 1.25 = 605 kN (61.7 t) against the working load; in motion
// 695.75 kN against the lesser of working load x 1.05 (ashore, 112 t) and a third of 5 times it:
// the first, so that 67.57 t are needed.
TEST(ShackleChoiceTest, ByTheChainsOfAStandard) {
  const Stock stock = stock_of({1900}, {55, 65, 70, 85});
  const ChosenShackle chosen = choose_shackle(stock, case_by_nd_0027(), facts_of_r1(), at_l1);
  ASSERT_TRUE(chosen.pass());
  EXPECT_EQ(stock.shackles[*chosen.index].name(), "b70");
  const Check& governing = *governing_check(chosen.checks);
  EXPECT_EQ(governing.name, "0027/ND, in motion");
  EXPECT_NEAR(governing.utilisation, 695.75e3 / (70e3 * 9.80665 * 1.05), 1e-9);
}

TEST(ShackleChoiceTest, SaysWhereNonePasses) {
  const ChosenShackle chosen =
      choose_shackle(stock_of({1900}, {10, 20}), case_with_factor(5), {}, at_l1);
  EXPECT_FALSE(chosen.pass());
  EXPECT_EQ(chosen.index, 1U);
  EXPECT_FALSE(choose_shackle(stock_of({1900}), case_with_factor(5), {}, at_l1).index);
}

}  // namespace
}  // namespace blocklift::pipeline
