#include "pipeline/lift/block_assessment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/lift/table_balance.h"
#include "structure/response/flexibility.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

using structure::Vector3;
using test::small_lift;
using test::SmallLift;

/// Responses of the small lift's block, once for all tests.
class SmallLiftBlock : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    responses_ = new structure::UnitResponses(*small_lift().model);
    recovery_ = new structure::StressRecovery(*responses_);
  }
  static void TearDownTestSuite() {
    delete recovery_;
    delete responses_;
  }
  static BlockAssessment assess(const dynamics::History& static_history,
                                const dynamics::History& dynamic_history) {
    const SmallLift& lift = small_lift();
    return assess_block(*responses_, *recovery_, attach_block(lift.run.model, lift.lugs()),
                        static_history, dynamic_history);
  }

  static structure::UnitResponses* responses_;
  static structure::StressRecovery* recovery_;
};
structure::UnitResponses* SmallLiftBlock::responses_ = nullptr;
structure::StressRecovery* SmallLiftBlock::recovery_ = nullptr;

TEST_F(SmallLiftBlock, HeadlineIsTheLargerOverAllRopes) {
  const dynamics::History& at_rest = small_lift().run.static_history;
  const dynamics::History& in_motion = small_lift().run.dynamic_history();
  const BlockAssessment block = assess(at_rest, in_motion);
  ASSERT_EQ(block.simultaneous_by_rope.size(), 4u);
  double at_rest_stress = 0, in_motion_stress = 0, at_rest_shift = 0, in_motion_shift = 0;
  for (const LoadComparison& way : block.simultaneous_by_rope) {
    at_rest_stress = std::max(at_rest_stress, way.static_state.result.checked_von_mises.value);
    in_motion_stress = std::max(in_motion_stress, way.dynamic_state.result.checked_von_mises.value);
    at_rest_shift = std::max(at_rest_shift, way.static_state.result.displacement.value);
    in_motion_shift = std::max(in_motion_shift, way.dynamic_state.result.displacement.value);

    // Each at the instant of its own rope's largest load.
    Eigen::Index sample = 0;
    const double tension = in_motion.rope(way.dynamic_state.rope).tension.maxCoeff(&sample);
    EXPECT_EQ(way.dynamic_state.time, in_motion.time(sample));
    EXPECT_EQ(way.static_state.rope, way.dynamic_state.rope);
    const auto& forces = way.dynamic_state.load.lug_forces_B;
    const auto lug = static_cast<std::size_t>(way.dynamic_state.rope.at(1) - '1');
    EXPECT_NEAR(forces.at(lug).norm(), tension, 1e-9 * tension);
  }
  EXPECT_EQ(block.simultaneous.static_state.result.checked_von_mises.value, at_rest_stress);
  EXPECT_EQ(block.simultaneous.dynamic_state.result.checked_von_mises.value, in_motion_stress);
  EXPECT_EQ(block.simultaneous.static_displacement, at_rest_shift);
  EXPECT_EQ(block.simultaneous.dynamic_displacement, in_motion_shift);
  EXPECT_NEAR(block.simultaneous.stress_increase_percent(),
              100 * (in_motion_stress / at_rest_stress - 1), 1e-9);
  EXPECT_NEAR(block.simultaneous.deformation_increase_percent(),
              100 * (in_motion_shift / at_rest_shift - 1), 1e-9);
}

TEST_F(SmallLiftBlock, FirstPeriodIsThatOfTheModesToAHundredth) {
  const double exact =
      2 * std::numbers::pi / structure::find_free_modes(*responses_, 1).angular_frequencies[0];
  EXPECT_NEAR(find_first_elastic_period(*responses_), exact, 0.01 * exact);
}

TEST_F(SmallLiftBlock, AMotionThatDoesNotBelongToTheForcesIsRefused) {
  const dynamics::History& at_rest = small_lift().run.static_history;
  dynamics::History wrong = small_lift().run.dynamic_history();
  for (dynamics::BodyHistory& body : wrong.bodies) {
    if (body.name == "load") body.acceleration.col(5).array() += 0.01;
  }
  try {
    assess(at_rest, wrong);
    FAIL() << "a block that accelerates without a force was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("\"largest dynamic load of rope R1\""));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("not in balance"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("1e-08"));
  }
}

TEST_F(SmallLiftBlock, LoadTableIsOneWayOnly) {
  const std::vector<Vector3> at_rest(4, Vector3(0, 0, 20e3));
  std::vector<Vector3> in_motion;
  for (const Vector3& force : at_rest) in_motion.push_back(1.1 * force);
  const BlockAssessment block = assess_load_table(*responses_, *recovery_, at_rest, in_motion);
  EXPECT_TRUE(block.simultaneous_by_rope.empty());
  // Linear: ten per cent more load, ten per cent more of everything.
  for (const LoadComparison* way : {&block.simultaneous, &block.per_rope_maxima}) {
    EXPECT_NEAR(way->stress_increase_percent(), 10, 1e-6);
    EXPECT_NEAR(way->deformation_increase_percent(), 10, 1e-6);
    EXPECT_FALSE(way->static_state.time.has_value());
  }
  const std::vector<Check> checks = check_block(small_lift().lift_case, block);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].demand, block.simultaneous.dynamic_state.result.checked_von_mises.value);
  EXPECT_NEAR(checks[0].limit, 355e6 / 1.5, 1e-3);
  EXPECT_FALSE(checks[0].note.empty());
}

/// 8 t with lugs 2 m and 1 m beside the centre of mass, and so high above it; radii of gyration of
/// 1, sqrt 2 and sqrt 3 m. @param forces_B one a lug, kN.
TableBalance balance_of_table(const std::vector<Vector3>& forces_B, double height = 1) {
  structure::MassProperties mass;
  mass.mass = 8000;
  mass.centre_of_mass_B = Vector3(5, 6, 7);
  mass.inertia_BBcm_B = 8000 * Vector3(1, 2, 3).asDiagonal();
  std::vector<structure::LiftingPoint> lugs(4);
  std::vector<Vector3> forces;
  for (std::size_t i = 0; i < 4; ++i) {
    lugs[i].p_BPin = mass.centre_of_mass_B + Vector3(i % 2 == 0 ? 2 : -2, i < 2 ? 1 : -1, height);
    forces.push_back(1e3 * forces_B[i]);
  }
  return find_table_balance(forces, lugs, mass, 9.81);
}

const Vector3 quarter_load(0, 0, 19.62);  // of the weight, kN

TEST(TableBalance, AQuarterOfTheWeightAtEachLugIsAtRest) {
  const TableBalance balance =
      balance_of_table({quarter_load, quarter_load, quarter_load, quarter_load});
  EXPECT_NEAR(balance.weight, 78.48e3, 1e-9);
  EXPECT_NEAR(balance.acceleration(), 0, 1e-12);
  EXPECT_NEAR(balance.lever(), 0, 1e-12);
  EXPECT_NEAR(balance.radius_of_gyration, std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(balance.is_off_weight() || balance.turns() || balance.presses_down() ||
               balance.bears_nothing());
}

TEST(TableBalance, HalfTheWeightFallsWithHalfOfGravity) {
  const Vector3 half = 0.5 * quarter_load;
  const TableBalance balance = balance_of_table({half, half, half, half});
  EXPECT_NEAR(balance.acceleration(), -0.5, 1e-12);
  EXPECT_TRUE(balance.is_off_weight());
  EXPECT_FALSE(balance.turns() || balance.presses_down() || balance.bears_nothing());
}

// 78.48 kN at (2, 1) m: moments of 78.48 and -156.96 kN m over 8 and 16 t m2.
TEST(TableBalance, TheWeightAtOneCornerTurnsTheBlock) {
  const Vector3 none = Vector3::Zero();
  const TableBalance balance = balance_of_table({4 * quarter_load, none, none, none});
  EXPECT_FALSE(balance.is_off_weight());
  EXPECT_NEAR(balance.lever(), std::sqrt(5.0), 1e-12);
  EXPECT_TRUE(balance.turns());
  EXPECT_NEAR((balance.angular_acceleration_B - Vector3(9.81, -9.81, 0)).norm(), 0, 1e-9);
}

// Loads down on lugs above the centre press; on lugs below it, or sideways, they may hold a block
// that hangs upside down or on its side.
TEST(TableBalance, LoadsThatPressAreKnownFromThoseOfATurnedBlock) {
  const std::vector<Vector3> down(4, -quarter_load), sideways(4, Vector3(0, 19.62, 0));
  EXPECT_TRUE(balance_of_table(down).presses_down());
  EXPECT_FALSE(balance_of_table(down, -1).presses_down());
  EXPECT_FALSE(balance_of_table(sideways).presses_down());
  EXPECT_TRUE(
      balance_of_table({quarter_load, -quarter_load, -quarter_load, quarter_load}).bears_nothing());
}

}  // namespace
}  // namespace blocklift::pipeline
