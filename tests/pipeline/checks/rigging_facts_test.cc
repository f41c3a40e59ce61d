#include "pipeline/checks/rigging_facts.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/checks/gather_facts.h"
#include "tests/pipeline/small_lift.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline {
namespace {

using test::small_lift;
using test::SmallLift;

LiftCase with_tolerances() {
  LiftCase lift_case = small_lift().lift_case;
  lift_case.standard.emplace();
  lift_case.standard->length_tolerance = 0.0025;
  lift_case.standard->centre_box = Vector3(0.1, 0.1, 0.1);
  return lift_case;
}

// In calm air: the wind has an upward share where the box hangs tilted.
TEST(RiggingFacts, HookLoadAtRestIsTheWeight) {
  LiftCase calm = with_tolerances();
  calm.wind.reset();
  const structure::MassProperties& mass = small_lift().mass();
  const LiftRun run =
      run_lift(calm, build_lift(calm, {mass.mass, mass.centre_of_mass_B, mass.inertia_BBcm_B}),
               [](const std::string&, double, const std::string&) {});
  const RiggingFacts rigging(calm, run, {}, {});
  const double weight = mass.mass * calm.gravity;
  for (const double load : rigging.hook_load(run.static_history))
    EXPECT_NEAR(load, weight, 1e-6 * weight);
}

// By statics the weight on the slings of one hook is the formula's share at no tilt.
TEST(RiggingFacts, TwoHooksShareAsAtRest) {
  const SmallLift& lift = small_lift();
  const LiftCase lift_case = with_tolerances();
  const RiggingFacts rigging(lift_case, lift.run, {}, {});
  const Eigen::Index last = lift.run.static_history.sample_count() - 1;
  double sum = 0;
  for (std::size_t h = 0; h < 2; ++h) {
    const auto computed = rigging.of_hook(h, last);
    ASSERT_TRUE(computed.two_hooks);
    double load = 0;
    for (std::size_t s = 0; s < rigging.slings().size(); ++s) {
      if (rigging.hook_of(s) != lift.run.model.hoists[h].name) continue;
      const auto rope = static_cast<std::size_t>(rigging.slings()[s].rope);
      load += lift.run.static_history.ropes[rope].last_force(last, 2);
    }
    const double share = load / rigging.hook_load(lift.run.static_history)[last];
    // The steady wind pushes at the load: its moment moves the share by some thousandths.
    EXPECT_NEAR(share_of_hook(*computed.two_hooks, 0), share, 0.01);
    sum += share_of_hook(*computed.two_hooks, 0);
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(RiggingFacts, TolerancesRaiseTheLoads) {
  const SmallLift& lift = small_lift();
  const LiftCase lift_case = with_tolerances();
  const RiggingFacts rigging(lift_case, lift.run, {}, {});
  for (std::size_t s = 0; s < rigging.slings().size(); ++s) {
    const ComputedFactors computed = rigging.of_sling(rigging.slings()[s], 0);
    ASSERT_TRUE(computed.skew);
    ASSERT_TRUE(computed.centre_box);
    EXPECT_GT(*computed.skew, 1);
    EXPECT_GT(*computed.centre_box, 1);
    EXPECT_LT(*computed.centre_box, 1.5);
    EXPECT_FALSE(rigging.weight_of(rigging.slings()[s]));
  }
}

/// The sample's lift below a spreader, its load's centre moved along.
LiftRun run_below_spreader(LiftCase lift_case, double shift) {
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2 + shift, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  return run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
}

double tension_at_rest(const LiftRun& run, const std::string& name) {
  for (const LiftRope& rope : run.model.ropes)
    if (rope.name == name) return run.static_history.ropes[rope.rope].tension[0];
  return 0;
}

LiftCase spreader_case(const test::TemporaryFolder& folder) {
  // Equilibria are asked for alone: the motion is short and rough.
  test::SampleLift lift = test::spreader_lift();
  for (const auto& [from, to] : {std::pair("by: -1 m", "by: -1 mm"),
                                 {"pause: 2 s", "pause: 0.1 s"},
                                 {"settle: 2 s", "settle: 0 s"},
                                 {"1e-8", "1e-4"}})
    lift.lift_case = test::with(lift.lift_case, from, to);
  lift.write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  lift_case.standard.emplace();
  return lift_case;
}

// A rule of levers: lugs and sheaves are 4 m apart, so that a centre 0.2 m out of the middle brings
// a hook 2.2 / 2 of the load, whatever its own block weighs. The load tilts by its ropes' stretch,
// which moves its centre by some tenths of a millimetre.
TEST(RiggingFacts, CentreBoxOfAHookLeavesItsBlockOut) {
  const test::TemporaryFolder folder;
  test::SampleLift lift;
  lift.lift_case = test::with(lift.lift_case, "settle: 10 s", "settle: 0 s");
  lift.write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  lift_case.standard.emplace();
  lift_case.standard->centre_box = Vector3(0.2, 0, 0);
  const LiftRun run = run_below_spreader(lift_case, 0);
  const RiggingFacts rigging(lift_case, run, {}, {});
  for (std::size_t hoist = 0; hoist < 2; ++hoist) {
    const ComputedFactors computed = rigging.of_hook(hoist, 0);
    ASSERT_TRUE(computed.centre_box);
    EXPECT_NEAR(*computed.centre_box, 1.1, 5e-4);
  }
  // The crane bears all of the load wherever its centre is, and however it tilts.
  EXPECT_NEAR(rigging.of_crane(0, 0).centre_box.value(), 1, 1e-6);
  EXPECT_TRUE(rigging.of_hook(0, 0).two_hooks);
  EXPECT_FALSE(rigging.of_crane(0, 0).two_hooks);
  EXPECT_TRUE(rigging.of_crane(0, 0).bears_all);
  EXPECT_FALSE(rigging.of_hook(0, 0).bears_all);
}

// Second method: the equilibrium of a lift whose centre of mass is where the box has its corner.
// The balance is of the first order, so that a quarter of its error is left when the box is halved.
TEST(RiggingFacts, CentreBoxBelowASpreaderIsThatOfAShiftedLoad) {
  const test::TemporaryFolder folder;
  LiftCase lift_case = spreader_case(folder);
  const LiftRun straight = run_below_spreader(lift_case, 0);
  const auto error_at = [&](double shift, const std::string& name) {
    lift_case.standard->centre_box = Vector3(shift, 0, 0);
    const RiggingFacts rigging(lift_case, straight, {}, {});
    const auto& slings = name[0] == 'U' ? rigging.slings_to_bars() : rigging.slings();
    // L1 and B1's end a lie at -x: the load's centre nearer to them loads R1 and U1.
    const LiftRun shifted = run_below_spreader(lift_case, -shift);
    const double exact = tension_at_rest(shifted, name) / tension_at_rest(straight, name);
    const ComputedFactors computed = rigging.of_sling(slings.front(), 0);
    EXPECT_GT(exact, 1.001);
    return *computed.centre_box - exact;
  };
  for (const char* name : {"R1", "U1"}) {
    const double whole = error_at(0.04, name), half = error_at(0.02, name);
    EXPECT_LT(std::abs(whole), 4e-3) << name;
    EXPECT_LT(std::abs(half), 0.3 * std::abs(whole) + 1e-6) << name;
  }
  EXPECT_TRUE(RiggingFacts(lift_case, straight, {}, {}).of_hook(0, 0).bears_all);
}

// The same with a sling that is shorter than meant: of all sets of signs the largest.
TEST(RiggingFacts, SkewBelowASpreaderIsThatOfWrongLengths) {
  const test::TemporaryFolder folder;
  LiftCase lift_case = spreader_case(folder);
  lift_case.standard->length_tolerance = 0.01;
  const LiftRun straight = run_below_spreader(lift_case, 0);
  const RiggingFacts rigging(lift_case, straight, {}, {});
  std::vector<std::string> names{"R1", "R2", "U1", "U2"};
  std::map<std::string, double> largest;
  for (unsigned set = 0; set < 16; ++set) {
    LiftCase wrong = lift_case;
    for (std::size_t i = 0; i < 4; ++i)
      for (given::Rope& rope : wrong.ropes)
        if (rope.name.value == names[i]) rope.length.value *= (set >> i & 1U) != 0 ? 1.01 : 0.99;
    const LiftRun run = run_below_spreader(std::move(wrong), 0);
    for (const std::string& name : names)
      largest[name] = std::max(largest[name], tension_at_rest(run, name));
  }
  for (const auto* slings : {&rigging.slings(), &rigging.slings_to_bars()})
    for (const LiftRope& sling : *slings) {
      const ComputedFactors computed = rigging.of_sling(sling, 0);
      const double exact = largest[sling.name] / tension_at_rest(straight, sling.name);
      EXPECT_GT(exact, 1.0001) << sling.name;
      // Of the second order in the lengths' errors.
      EXPECT_NEAR(*computed.skew, exact, 2e-3) << sling.name;
    }
}

// A standard takes slings above a bar as it takes those to lugs, and the bar's weight as rigging's.
TEST(RiggingFacts, TakeSlingsAboveASpreader) {
  const test::TemporaryFolder folder;
  LiftCase lift_case = spreader_case(folder);
  lift_case.standard->length_tolerance = 0.0025;
  LiftRun run = run_below_spreader(lift_case, 0);
  const double bar = lift_case.find_spreader("B1")->mass() * lift_case.gravity;
  const Assessment assessment{std::move(lift_case), std::move(run), {}, {}, {}, {}, 0};
  const LiftFacts facts = gather_facts(assessment);
  ASSERT_EQ(facts.slings.size(), 4U);
  EXPECT_EQ(facts.slings[0].name, "R1");
  EXPECT_EQ(facts.slings[2].name, "U1");
  EXPECT_EQ(facts.slings[2].lug, "");
  EXPECT_TRUE(facts.slings[0].is_at_load);
  EXPECT_FALSE(facts.slings[2].is_at_load);
  EXPECT_GT(facts.slings[2].load.at_rest, facts.slings[0].load.at_rest);
  for (const SlingFacts& sling : facts.slings) {
    EXPECT_EQ(sling.hook, "C1.left");
    EXPECT_EQ(sling.slings_on_hook, 2);
    EXPECT_TRUE(sling.computed.skew);
  }
  EXPECT_NEAR(facts.rigging, bar, 1e-9 * bar);
  // The loads of the hook in the motion have the bar already.
  EXPECT_EQ(facts.hooks[0].rigging, 0);
}

// Two slings side by side from hook to lug: the lug bears both, half of the weight.
TEST(RiggingFacts, ALugBearsAllSlingsThatEndAtIt) {
  const test::TemporaryFolder folder;
  test::SampleLift lift;
  lift.lift_case = test::with(
      lift.lift_case, "  R2: {from",
      "  R3: {from: C1.left, to: L1, length: 2 m, model: {axial_stiffness: 20 MN, breaking_load: "
      "1000 kN}}\n  R2: {from");
  lift.lift_case = test::with(lift.lift_case, "settle: 10 s", "settle: 0 s");
  lift.write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  lift_case.standard.emplace();
  LiftRun run = run_below_spreader(lift_case, 0);
  const double half_weight = 5e3 * lift_case.gravity;
  const Assessment assessment{std::move(lift_case), std::move(run), {}, {}, {}, {}, 0};
  const LiftFacts facts = gather_facts(assessment);
  ASSERT_EQ(facts.pulls.size(), 2U);
  const LugPull& pull = facts.pulls[0];
  EXPECT_EQ(pull.lug, "L1");
  ASSERT_EQ(pull.slings.size(), 2U);
  EXPECT_EQ(pull.slings[0].sling, "R1");
  EXPECT_EQ(pull.slings[1].sling, "R3");
  EXPECT_NEAR(pull.load.at_rest, half_weight, 5e-3 * half_weight);
  const structure::Vector3 sum = pull.slings[0].force + pull.slings[1].force;
  EXPECT_NEAR(sum.norm(), pull.load.at_rest, 1e-9 * half_weight);
  EXPECT_GT(sum.z(), 0.99 * half_weight);
  // The stiffer one bears ten times as much as the other, and less than the lug.
  EXPECT_NEAR(pull.slings[0].force.norm(), half_weight * 10 / 11, 0.01 * half_weight);
  EXPECT_NEAR(pull.load.in_motion,
              pull.load.at_rest * pull.load.amplification * pull.load.resharing,
              1e-6 * half_weight);
  EXPECT_EQ(facts.pulls[1].lug, "L2");
  EXPECT_EQ(facts.pulls[1].load.at_rest, facts.slings[2].load.at_rest);
}

}  // namespace
}  // namespace blocklift::pipeline
