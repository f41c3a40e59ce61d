// Every instant of the small lift.
#include "pipeline/lift/history_assessment.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/lift/stage_stresses.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

using test::small_lift;
using test::SmallLift;

class SmallLiftHistory : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const SmallLift& lift = small_lift();
    responses_ = new structure::UnitResponses(*lift.model);
    recovery_ = new structure::StressRecovery(*responses_);
    attachment_ = new BlockAttachment(attach_block(lift.run.model, lift.lugs()));
    block_ = new BlockAssessment(assess_block(*responses_, *recovery_, *attachment_,
                                              lift.run.static_history, lift.run.dynamic_history()));
  }
  static void TearDownTestSuite() {
    delete block_;
    delete attachment_;
    delete recovery_;
    delete responses_;
  }
  static HistoryAssessment assess(const dynamics::History& in_motion,
                                  const HistorySettings& settings = {}) {
    return assess_history(*responses_, *recovery_, *attachment_, small_lift().run.static_history,
                          in_motion, *block_, settings);
  }

  static structure::UnitResponses* responses_;
  static structure::StressRecovery* recovery_;
  static BlockAttachment* attachment_;
  static BlockAssessment* block_;
};
structure::UnitResponses* SmallLiftHistory::responses_ = nullptr;
structure::StressRecovery* SmallLiftHistory::recovery_ = nullptr;
BlockAttachment* SmallLiftHistory::attachment_ = nullptr;
BlockAssessment* SmallLiftHistory::block_ = nullptr;

TEST_F(SmallLiftHistory, IsTheLargestOfEverySample) {
  const dynamics::History& in_motion = small_lift().run.dynamic_history();
  const HistoryAssessment history = assess(in_motion);
  const structure::MassProperties& mass = small_lift().mass();
  double largest = 0;
  Eigen::Index when = 0;
  for (Eigen::Index sample = 0; sample < in_motion.sample_count(); ++sample) {
    const double stress =
        recovery_->checked()
            .von_mises(responses_->coefficients(map_instant(in_motion, sample, *attachment_, mass)))
            .maxCoeff();
    if (stress > largest) {
      largest = stress;
      when = sample;
    }
  }
  const HistoryExtreme& checked = history.dynamic_state.checked_von_mises;
  EXPECT_NEAR(checked.at.value, largest, 1e-9 * largest);
  EXPECT_EQ(checked.time, in_motion.time(when));
  EXPECT_GE(largest,
            block_->simultaneous.dynamic_state.result.checked_von_mises.value * (1 - 1e-9));
  EXPECT_EQ(history.dynamic_state.square_von_mises.maxCoeff(), checked.at.value);
  EXPECT_NEAR(history.stress_increase_percent(),
              100 * (largest / history.static_state.checked_von_mises.at.value - 1), 1e-6);
  // A rope governs it, with a share of the stress that is worth the name.
  EXPECT_THAT(history.ropes, ::testing::Contains(checked.rope));
  EXPECT_GT(checked.share, 0.25);
  EXPECT_LT(checked.share, 2);
  EXPECT_LT(history.dynamic_state.largest_force_residual, largest_balance_residual);
  EXPECT_GT(history.dynamic_state.largest_principal.at.value, 0);
  EXPECT_LT(history.dynamic_state.smallest_principal.at.value, 0);
}

// Against every sample of each half of the lift, one by one.
TEST_F(SmallLiftHistory, StagesHaveTheLargestOfTheirSamples) {
  const dynamics::History& in_motion = small_lift().run.dynamic_history();
  const HistoryAssessment history = assess(in_motion);
  const double end = in_motion.time(in_motion.sample_count() - 1);
  const std::vector<StageStress> stages = find_stage_stresses(
      {{"first", 0, end / 2}, {"second", end / 2, end}, {"never", end + 1, end + 2}}, *responses_,
      *recovery_, history);
  ASSERT_EQ(stages.size(), 2U);
  double largest_of_stages = 0;
  for (const StageStress& stage : stages) {
    double largest = 0;
    for (Eigen::Index sample = 0; sample < in_motion.sample_count(); ++sample) {
      if (in_motion.time(sample) < stage.start - 1e-6 || in_motion.time(sample) > stage.end + 1e-6)
        continue;
      largest = std::max(
          largest,
          recovery_->checked().von_mises(history.dynamic_state.factors.col(sample)).maxCoeff());
    }
    const HistoryExtreme& found = stage.in_motion;
    EXPECT_NEAR(found.at.value, largest, 1e-9 * largest) << stage.stage;
    EXPECT_GE(found.time, stage.start - 1e-6);
    EXPECT_LE(found.time, stage.end + 1e-6);
    EXPECT_EQ(found.time, in_motion.time(found.at.instant));
    EXPECT_FALSE(found.at.part.empty());
    ASSERT_TRUE(stage.increase_percent);
    EXPECT_NEAR(*stage.increase_percent, 100 * (largest / stage.at_rest.at.value - 1), 1e-6);
    largest_of_stages = std::max(largest_of_stages, found.at.value);
  }
  EXPECT_NEAR(largest_of_stages, history.dynamic_state.checked_von_mises.at.value,
              1e-12 * largest_of_stages);

  // A block that bears next to nothing at rest has no increase.
  HistoryAssessment on_supports = history;
  on_supports.static_state.factors.leftCols(1) *= 1e-3;
  on_supports.static_state.square_von_mises = history.static_state.square_von_mises;
  const double first = history.static_state.time(0);
  const std::vector<StageStress> standing =
      find_stage_stresses({{"standing", first, first}}, *responses_, *recovery_, on_supports);
  ASSERT_EQ(standing.size(), 1U);
  EXPECT_GT(standing[0].at_rest.at.value, 0);
  EXPECT_FALSE(standing[0].increase_percent);
}

// The instants of the ropes' maxima are among all instants: alone they cannot give more.
TEST_F(SmallLiftHistory, ChosenInstantsAreNeverMoreThanAllOfThem) {
  const HistoryAssessment history = assess(small_lift().run.dynamic_history());
  EXPECT_LE(history.rope_instants.largest_percent, 1e-9);
  EXPECT_LE(history.rope_instants.worst_percent, 1e-9);
  EXPECT_GE(history.rope_instants.squares_short, 0);
  EXPECT_LE(history.rope_instants.squares_short, 1);
  EXPECT_LE(history.per_rope_maxima.worst_percent, history.per_rope_maxima.largest_percent + 1e-9);
}

TEST_F(SmallLiftHistory, ChecksTakeTheEnvelope) {
  const HistoryAssessment history = assess(small_lift().run.dynamic_history());
  const std::vector<Check> checks = check_block(small_lift().lift_case, *block_, &history);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].demand, std::max(history.dynamic_state.checked_von_mises.at.value,
                                       history.static_state.checked_von_mises.at.value));
  EXPECT_TRUE(checks[0].time.has_value());
}

// Rules for small elements: a line for the field by yield / 1.5, lines for corners by their factors
// on that, and the largest of all three is the stress that is checked without them.
TEST_F(SmallLiftHistory, RulesForCornersHaveLinesOfTheirOwn) {
  const HistoryAssessment history = assess(small_lift().run.dynamic_history());
  LiftCase lift_case = small_lift().lift_case;
  lift_case.standard.emplace();
  lift_case.standard->rules.fine_mesh = FineMeshRules{0.05, {1.7, "6.2.1 a"}, {1.5, "6.2.1 b"}};
  for (const bool is_table : {false, true}) {
    const std::vector<Check> checks =
        check_block(lift_case, *block_, is_table ? nullptr : &history);
    ASSERT_GE(checks.size(), 2u);
    double largest = 0;
    for (const Check& check : checks) {
      largest = std::max(largest, check.demand);
      const bool in_field = check.name.find("away from corners") != std::string::npos;
      const bool beside_weld = check.name.find("at corners beside welds") != std::string::npos;
      EXPECT_NEAR(check.limit,
                  (in_field      ? 1
                   : beside_weld ? 1.5
                                 : 1.7) *
                      355e6 / 1.5,
                  1e-3)
          << check.name;
      EXPECT_EQ(check.note.find("6.2.1") == std::string::npos, in_field) << check.note;
      EXPECT_TRUE(check.is_by_mesh);
    }
    EXPECT_EQ(
        largest,
        check_block(small_lift().lift_case, *block_, is_table ? nullptr : &history).front().demand);
  }
}

TEST_F(SmallLiftHistory, FollowsTheHotSpotAndEachLugUnlessPointsAreChosen) {
  const HistoryAssessment history = assess(small_lift().run.dynamic_history());
  ASSERT_EQ(history.points.size(), 5u);
  const StressHistory& hot = history.points[0];
  EXPECT_EQ(hot.name, "hot spot");
  EXPECT_NEAR(hot.dynamic_von_mises.maxCoeff(), history.dynamic_state.checked_von_mises.at.value,
              1e-9 * hot.dynamic_von_mises.maxCoeff());
  // Membrane stress has two principal stresses; the larger is at most 2/sqrt(3) of von Mises.
  EXPECT_LE(hot.dynamic_normal.cwiseAbs().maxCoeff(), 1.16 * hot.dynamic_von_mises.maxCoeff());
  EXPECT_GE(hot.dynamic_normal.cwiseAbs().maxCoeff(), 0.5 * hot.dynamic_von_mises.maxCoeff());
  EXPECT_FALSE(hot.cycles.empty());
  EXPECT_GT(hot.damage_per_lift, 0);

  HistorySettings settings;
  settings.points = {{"corner", small_lift().lugs()[1].p_BPin}};
  settings.fatigue_curve = "W3";
  settings.stress_concentration = 2;
  const HistoryAssessment chosen = assess(small_lift().run.dynamic_history(), settings);
  ASSERT_EQ(chosen.points.size(), 1u);
  EXPECT_EQ(chosen.points[0].name, "corner");
  EXPECT_LT((chosen.points[0].point_B - small_lift().lugs()[1].p_BPin).norm(), 1);
  // Twice the range on the flat branch of slope 5 (all ranges are small): 32 times the damage.
  settings.stress_concentration = 1;
  const double once =
      assess(small_lift().run.dynamic_history(), settings).points[0].damage_per_lift;
  EXPECT_NEAR(chosen.points[0].damage_per_lift, 32 * once, 1e-9 * 32 * once);
}

// A lift takes each place from no stress to its own and back, also where the block hangs all the
// time: the largest range is max(s, 0) - min(s, 0).
TEST_F(SmallLiftHistory, ALiftIsACycleFromNoStress) {
  for (const dynamics::History* motion :
       {&small_lift().run.dynamic_history(), &small_lift().run.static_history})
    for (const StressHistory& point : assess(*motion).points) {
      double largest_range = 0;
      for (const structure::Cycles& cycles : point.cycles)
        largest_range = std::max(largest_range, cycles.range);
      const double expected = std::max(point.dynamic_normal.maxCoeff(), 0.0) -
                              std::min(point.dynamic_normal.minCoeff(), 0.0);
      EXPECT_NEAR(largest_range, expected, 1e-12 * expected) << point.name;
    }
}

TEST_F(SmallLiftHistory, ASampleOutOfBalanceIsRefused) {
  dynamics::History wrong = small_lift().run.dynamic_history();
  const Eigen::Index sample = wrong.sample_count() / 2;
  for (dynamics::BodyHistory& body : wrong.bodies)
    if (body.name == "load") body.acceleration(sample, 5) += 0.01;
  try {
    assess(wrong);
    FAIL() << "a sample that accelerates without a force was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("dynamic loads on the block at"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("not in balance"));
  }
}

}  // namespace
}  // namespace blocklift::pipeline
