#include "pipeline/checks/rigging_facts.h"

#include <cmath>

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
    const ComputedFactors computed = rigging.of_sling(s, 0);
    ASSERT_TRUE(computed.skew);
    ASSERT_TRUE(computed.centre_box);
    EXPECT_GT(*computed.skew, 1);
    EXPECT_GT(*computed.centre_box, 1);
    EXPECT_LT(*computed.centre_box, 1.5);
    EXPECT_FALSE(rigging.weight_of(rigging.slings()[s]));
  }
}

// A standard takes slings above a bar as it takes those to lugs, and the bar's weight as rigging's;
// what a balance of single ropes would compute is left out.
TEST(RiggingFacts, TakeSlingsAboveASpreader) {
  const test::TemporaryFolder folder;
  test::spreader_lift().write(folder);
  LiftCase lift_case = read_lift_case("case.yaml");
  lift_case.standard.emplace();
  lift_case.standard->length_tolerance = 0.0025;
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  const double bar = lift_case.find_spreader("B1")->mass() * lift_case.gravity;
  const Assessment assessment{std::move(lift_case), std::move(run), {}, {}, {}, {}, 0};
  const LiftFacts facts = gather_facts(assessment);
  ASSERT_EQ(facts.slings.size(), 4U);
  EXPECT_EQ(facts.slings[0].name, "R1");
  EXPECT_EQ(facts.slings[2].name, "U1");
  EXPECT_EQ(facts.slings[2].lug, "");
  EXPECT_GT(facts.slings[2].load.at_rest, facts.slings[0].load.at_rest);
  for (const SlingFacts& sling : facts.slings) {
    EXPECT_EQ(sling.hook, "C1.left");
    EXPECT_EQ(sling.slings_on_hook, 2);
    EXPECT_FALSE(sling.computed.skew);
  }
  EXPECT_NEAR(facts.rigging, bar, 1e-9 * bar);
  // The loads of the hook in the motion have the bar already.
  EXPECT_EQ(facts.hooks[0].rigging, 0);
}

}  // namespace
}  // namespace blocklift::pipeline
