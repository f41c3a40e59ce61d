#include "pipeline/checks/checks.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/lift/history_figures.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

using test::small_lift;
using test::SmallLift;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Check, DemandMayReachTheLimitAndNoMore) {
  const Check half = check_at_most("rope", 50, 100, "N");
  EXPECT_TRUE(half.pass);
  EXPECT_EQ(half.utilisation, 0.5);
  EXPECT_TRUE(check_at_most("rope", 100, 100, "N").pass);
  const Check above = check_at_most("rope", 101, 100, "N");
  EXPECT_FALSE(above.pass);
  EXPECT_EQ(above.utilisation, 1.01);
  EXPECT_FALSE(check_at_most("rope", 1, 0, "N").pass);
}

TEST(Check, DemandMayFallToTheLimitAndNoFurther) {
  const Check twice = check_at_least("slack", 20, 10, "N");
  EXPECT_TRUE(twice.pass);
  EXPECT_EQ(twice.utilisation, 0.5);
  EXPECT_TRUE(check_at_least("slack", 10, 10, "N").pass);
  EXPECT_FALSE(check_at_least("slack", 9, 10, "N").pass);
  EXPECT_GT(check_at_least("slack", 9, 10, "N").utilisation, 1);
  // Without a limit the rope must still pull.
  EXPECT_TRUE(check_at_least("slack", 1e-3, 0, "N").pass);
  EXPECT_FALSE(check_at_least("slack", 0, 0, "N").pass);
  EXPECT_GT(check_at_least("slack", 0, 0, "N").utilisation, 1);
}

TEST(Check, WhatIsNotANumberFails) {
  for (const Check& check : {check_at_most("a", nan, 1, "N"), check_at_most("b", 1, nan, "N"),
                             check_at_least("c", nan, 1, "N"), check_at_least("d", 1, nan, "N"),
                             check_at_least("e", nan, 0, "N")}) {
    EXPECT_FALSE(check.pass) << check.name;
    EXPECT_GT(check.utilisation, 1) << check.name;
    EXPECT_TRUE(std::isfinite(check.utilisation)) << check.name;
  }
}

TEST(Verdict, NamesWhatFailsOrElseWhatGoverns) {
  const Check low = check_at_most("rope R1", 20, 100, "N");
  const Check high = check_at_most("crane C1", 90, 100, "N");
  EXPECT_TRUE(all_pass({low, high}));
  EXPECT_EQ(governing_check({}), nullptr);
  EXPECT_THAT(verdict_reasons({low, high}), ElementsAre("governed by crane C1: utilisation 0.90"));
  const Check over = check_at_most("rope R2", 130, 100, "N");
  const Check swing = check_at_most("swing", nan, 0.1, "rad");
  EXPECT_FALSE(all_pass({low, over, high}));
  EXPECT_THAT(verdict_reasons({low, over, high, swing}),
              ElementsAre("rope R2: utilisation 1.30", "swing: beyond any limit"));
  EXPECT_TRUE(verdict_reasons({}).empty());
}

const Check& find_check(const std::vector<Check>& checks, const std::string& start) {
  for (const Check& check : checks) {
    if (check.name.starts_with(start)) return check;
  }
  throw std::runtime_error("no check begins with " + start);
}

TEST(LiftChecks, SlingsMayLieSlackWhileTheLoadStands) {
  const SmallLift& lift = small_lift();
  const auto slack = [&](const LiftRun& run) {
    const std::vector<Check> checks = check_lift(lift.lift_case, run);
    return find_check(checks, "slack: smallest tension of any rope").demand;
  };
  const double hanging = slack(lift.run);
  ASSERT_GT(hanging, 0);
  LiftRun run = lift.run;
  dynamics::History& history = run.dynamic_result.history;
  history.ropes[run.model.ropes[0].rope].tension[3] = 0;
  EXPECT_EQ(slack(run), 0);
  history.supports.push_back({"pad", Eigen::VectorXd::Zero(history.sample_count())});
  EXPECT_EQ(slack(run), 0);
  history.supports.back().normal_force[3] = 1e3;
  EXPECT_EQ(slack(run), hanging);
  // A tackle may not, even then.
  history.ropes[run.model.hoists[0].rope].tension[3] = 0;
  EXPECT_EQ(slack(run), 0);
}

// A tackle that bears its hook block alone is not held against the smallest tension of ropes.
TEST(LiftChecks, IdleHooksAreNotSlack) {
  const SmallLift& lift = small_lift();
  LiftCase lift_case = lift.lift_case;
  LiftRun run = lift.run;
  const auto slack = [&] {
    const std::vector<Check> checks = check_lift(lift_case, run);
    return find_check(checks, "slack: smallest tension of any rope");
  };
  const double slings = slack().demand;
  Eigen::VectorXd& tackle = run.dynamic_result.history.ropes[run.model.hoists[0].rope].tension;
  tackle[3] = 0.5 * slings;  // slings at its hook, and the load hangs: it counts
  EXPECT_EQ(slack().demand, 0.5 * slings);
  dynamics::History& history = run.dynamic_result.history;
  history.supports.push_back({"pad", Eigen::VectorXd::Zero(history.sample_count())});
  history.supports.back().normal_force[3] = 1e3;
  EXPECT_EQ(slack().demand, slings);  // the load stands
  history.supports.clear();
  const std::string idle = run.model.hoists[0].name, other = run.model.hoists[1].name;
  ASSERT_EQ(lift_case.ropes[0].path.front().body_name(lift_case.cranes), idle);
  ASSERT_EQ(lift_case.ropes[1].path.front().body_name(lift_case.cranes), other);
  const ResolvedPoint hook = lift_case.ropes[1].path.front();
  for (given::Rope& rope : lift_case.ropes) rope.path.front() = hook;
  EXPECT_EQ(slack().demand, slings);  // nothing hangs on its hook
  tackle[3] = 0;
  EXPECT_EQ(slack().demand, 0);
}

TEST(LiftChecks, EveryLineHasItsDemandAndLimit) {
  const SmallLift& lift = small_lift();
  const std::vector<Check> checks = check_lift(lift.lift_case, lift.run);
  // 4 ropes, 2 tackles, 2 hoists, 1 crane, slack, swing.
  ASSERT_EQ(checks.size(), 11u);
  const dynamics::History& in_motion = lift.run.dynamic_history();

  const Check& rope = find_check(checks, "rope R1: tension against breaking load / 5");
  Eigen::Index at = 0;
  const double largest = in_motion.rope("R1").tension.maxCoeff(&at);
  EXPECT_EQ(rope.demand, largest);  // larger than at rest
  EXPECT_EQ(rope.time, in_motion.time(at));
  EXPECT_NEAR(rope.limit, 30e3 * 9.80665 / 5, 1e-6);
  EXPECT_EQ(rope.unit, "N");
  EXPECT_TRUE(rope.pass);

  const Check& hoist = find_check(checks, "hoist C1.left: load against capacity");
  EXPECT_EQ(hoist.demand, in_motion.rope("C1.left").tension.maxCoeff());
  EXPECT_NEAR(hoist.limit, 8e3 * 9.80665, 1e-6);
  const Check& crane = find_check(checks, "crane C1: load of all hoists");
  EXPECT_EQ(crane.demand,
            (in_motion.rope("C1.left").tension + in_motion.rope("C1.right").tension).maxCoeff());
  EXPECT_NEAR(crane.limit, 12e3 * 9.80665, 1e-6);

  const Check& slack = find_check(checks, "slack: smallest tension of any rope, R");
  EXPECT_EQ(slack.limit, 1e3);
  EXPECT_LT(slack.demand, 30e3);
  EXPECT_GT(slack.demand, 10e3);
  const Check& swing = find_check(checks, "swing: largest angle of a hoist");
  EXPECT_GT(swing.demand, swing_angles(lift.run.static_history.rope("C1.left").last_force)(0));
  EXPECT_EQ(swing.unit, "rad");
}

// Round four diameters 1 - 0.5 / sqrt(4) = 3/4 of a wire rope's breaking load are left.
TEST(LiftChecks, ABendTakesOfTheBreakingLoad) {
  const SmallLift& lift = small_lift();
  LiftCase lift_case = lift.lift_case;
  lift_case.ropes[0].rope.diameter = 0.05;
  lift_case.ropes[0].bend_diameter = Located<double>{0.2, {}};
  const std::vector<Check> checks = check_lift(lift_case, lift.run);
  const Check& bent = find_check(checks, "rope R1: tension against breaking load / 5");
  EXPECT_NEAR(bent.limit, 0.75 * 30e3 * 9.80665 / 5, 1e-6);
  EXPECT_THAT(bent.note, HasSubstr("bent round D/d 4.00: 75.0 % of the breaking load is left"));
  EXPECT_NEAR(find_check(checks, "rope R2").limit, 30e3 * 9.80665 / 5, 1e-6);
}

TEST(LiftChecks, AsksForWhatTheCaseAsksFor) {
  const SmallLift& lift = small_lift();
  LiftCase lift_case = lift.lift_case;
  lift_case.checks.crane_capacity = false;
  lift_case.checks.largest_swing.reset();
  lift_case.checks.rope_safety_factor = 1000;
  const std::vector<Check> checks = check_lift(lift_case, lift.run);
  EXPECT_EQ(checks.size(), 7u);
  EXPECT_FALSE(all_pass(checks));
  EXPECT_FALSE(find_check(checks, "rope R3").pass);
  EXPECT_TRUE(find_check(checks, "slack").pass);
}

// A history that breaks off into what is not a number must not pass by its sound half.
TEST(LiftChecks, TensionsThatAreNotNumbersFail) {
  const LiftCase lift_case = small_lift().lift_case;
  LiftRun run{small_lift().run.model, small_lift().run.static_history,
              small_lift().run.dynamic_result};
  for (dynamics::RopeHistory& rope : run.dynamic_result.history.ropes)
    rope.tension.tail(rope.tension.size() / 2).setConstant(nan);
  const std::vector<Check> checks = check_lift(lift_case, run);
  for (const char* name :
       {"rope R1", "rope R4", "tackle C1.left", "hoist C1.right", "crane C1", "slack"})
    EXPECT_FALSE(find_check(checks, name).pass) << name;
}

TEST(SwingAngle, IsThatOfThePullOnTheHookAgainstThePlumb) {
  dynamics::RopeHistory rope;
  rope.last_force.resize(4, 3);
  rope.last_force << 0, 0, 10,  // plumb
      3, 4, 5,                  // 45 degrees
      0, 2, 0,                  // level
      0, 0, 0;                  // slack
  const Eigen::VectorXd angles = swing_angles(hook_pull(rope, false));
  const double quarter = std::acos(-1.0) / 4;
  EXPECT_NEAR(angles(0), 0, 1e-15);
  EXPECT_NEAR(angles(1), quarter, 1e-15);
  EXPECT_NEAR(angles(2), 2 * quarter, 1e-15);
  EXPECT_EQ(angles(3), 0);
}

TEST(EnergyImbalance, IsWhatTheTermsLeaveUnexplained) {
  dynamics::EnergyHistory energy;
  const Eigen::Vector3d step(0, 1, 2);
  energy.kinetic = 1 * step;
  energy.gravity = Eigen::Vector3d::Constant(100) + 2 * step;
  energy.elastic = 3 * step;
  EXPECT_EQ(energy_imbalance(energy).size(), 0);  // no works: nothing to compare with
  energy.drive_work = 4 * step;
  energy.winch_work = 5 * step;
  energy.outside_work = -1 * step;
  energy.dissipated = 2.5 * step;
  EXPECT_LT((energy_imbalance(energy) - 0.5 * step).norm(), 1e-12);

  // And of a real run it is small beside what was turned over.
  const dynamics::EnergyHistory& run = small_lift().run.dynamic_history().energy;
  EXPECT_LT(energy_imbalance(run).cwiseAbs().maxCoeff(),
            1e-3 * run.winch_work.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace blocklift::pipeline
