// Lifts by cranes whose linkages are closed by loops, against trigonometry and statics by hand.
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/checks/loop_loads.h"
#include "pipeline/lift/history_figures.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;
using test::with;

constexpr double degree = std::numbers::pi / 180;
constexpr double g = 9.81;

LiftRun run_quietly(const LiftCase& lift_case, const LoadMass& load) {
  return run_lift(lift_case, build_lift(lift_case, load),
                  [](const std::string&, double, const std::string&) {});
}

/// The four-bar of models/cranes/level-luffing-40t in the plane of its jib: x outwards, z up, from
/// the platform's origin (m), at a luffing angle. The circles about head and tower meet in the
/// tie's pin.
struct FourBar {
  explicit FourBar(double luff)
      : head(foot + 27.72 * Eigen::Vector2d(std::cos(luff), std::sin(luff))) {
    const Eigen::Vector2d span = tower - head;
    const double distance = span.norm();
    const double angle =
        std::acos((4.43 * 4.43 + distance * distance - 25.45 * 25.45) / (2 * 4.43 * distance));
    const double rear = std::atan2(span.y(), span.x()) - angle;
    const double front = rear + std::numbers::pi + 0.18;
    pin = head + 4.43 * Eigen::Vector2d(std::cos(rear), std::sin(rear));
    along_fly = Eigen::Vector2d(std::cos(front), std::sin(front));
    tip = head + 12.18 * along_fly;
    jib_centre_height = 0.48 * 27.72 * std::sin(luff);
  }
  Eigen::Vector2d foot{2, 0}, tower{-4, 8.53};
  Eigen::Vector2d head, pin, along_fly, tip;
  double jib_centre_height;

  /// Potential energy of jib, fly jib, tie and a force that pulls the tip down, J.
  double potential(double pull) const {
    const double tie_centre = 0.5 * (tower.y() + pin.y());
    const double fly_centre = (head + 2.8 * along_fly).y();
    return g * (24e3 * jib_centre_height + 9e3 * fly_centre + 6e3 * tie_centre) + pull * tip.y();
  }
};

/// The lift in tests/pipeline/cases/level-luffing, its load a box of 8 t.
class LevelLuffing : public ::testing::Test {
 protected:
  static const LiftRun& run() {
    static const LiftRun lift = run_quietly(read_lift_case(BLOCKLIFT_LEVEL_LUFFING), box());
    return lift;
  }
  static LoadMass box() {
    return {8e3, {2.05, 1.48, 0.75}, Vector3(9, 16, 25).asDiagonal() * (8e3 / 12)};
  }
  static double luff_at(const dynamics::History& history, Eigen::Index sample) {
    for (const dynamics::DriveHistory& drive : history.drives) {
      if (drive.name == "C1.luff") return drive.position[sample];
    }
    throw std::logic_error("no drive C1.luff");
  }
  static double luff_moment_at(const dynamics::History& history, Eigen::Index sample) {
    for (const dynamics::DriveHistory& drive : history.drives) {
      if (drive.name == "C1.luff") return drive.force[sample];
    }
    throw std::logic_error("no drive C1.luff");
  }
};

// The sheave stands where two circles meet, at rest and in motion, and keeps its height within 0.6
// m while it comes in by more than 20 m: what a level-luffing crane is built for.
TEST_F(LevelLuffing, CarriesTheSheaveAsTheFourBarLeadsIt) {
  for (const dynamics::History* history : {&run().static_history, &run().dynamic_history()}) {
    double lowest = 1e9, highest = 0, nearest = 1e9, furthest = 0;
    for (Eigen::Index i = 0; i < history->sample_count(); ++i) {
      const dynamics::Pose X_WP = history->body("C1.platform").X_WB(i);
      const Vector3 tip_P =
          X_WP.inverse().apply(history->body("C1.fly_jib").X_WB(i).apply(Vector3(12.18, 0, 0)));
      const FourBar expected(luff_at(*history, i));
      ASSERT_NEAR(tip_P.x(), expected.tip.x(), 1e-8) << "sample " << i;
      ASSERT_NEAR(tip_P.y(), 0, 1e-9);
      ASSERT_NEAR(tip_P.z(), expected.tip.y(), 1e-8);
      lowest = std::min(lowest, tip_P.z());
      highest = std::max(highest, tip_P.z());
      nearest = std::min(nearest, tip_P.x());
      furthest = std::max(furthest, tip_P.x());
    }
    EXPECT_LT(highest - lowest, 0.6);
    EXPECT_GT(furthest - nearest, 20);
  }
}

// Virtual work: the luffing moment at rest is what the potential energy gains over the angle. The
// pull at the tip is that of the tackle, which hangs plumb. Central difference over 1e-4 rad:
// relative error some 1e-8.
TEST_F(LevelLuffing, NeedsTheLuffingMomentOfVirtualWork) {
  const dynamics::History& rest = run().static_history;
  for (Eigen::Index i = 0; i < rest.sample_count(); ++i) {
    const double luff = luff_at(rest, i);
    const double pull = rest.rope("C1.main").tension[i];
    ASSERT_NEAR(pull, (8e3 + 1.2e3) * g, 1);
    const double expected =
        (FourBar(luff + 1e-4).potential(pull) - FourBar(luff - 1e-4).potential(pull)) / 2e-4;
    ASSERT_NEAR(luff_moment_at(rest, i), expected, 1e-5 * std::abs(expected)) << "sample " << i;
  }
}

// The tie hangs between two pins: about the tower's, the moments of its weight and of the pin at
// the fly jib vanish, and all of it is in the plane of the jib.
TEST_F(LevelLuffing, LoadsTheTieAsItsBalanceAsks) {
  const dynamics::History& rest = run().static_history;
  const dynamics::LoopHistory& pin = rest.loop("C1.tie_pin");
  for (Eigen::Index i = 0; i < rest.sample_count(); ++i) {
    const FourBar bars(luff_at(rest, i));
    const dynamics::Pose X_WP = rest.body("C1.platform").X_WB(i);
    const Vector3 force_on_tie_P = -(X_WP.R.transpose() * pin.force.row(i).tail<3>().transpose());
    const Eigen::Vector2d arm = bars.pin - bars.tower;
    const double moment =
        arm.x() * force_on_tie_P.z() - arm.y() * force_on_tie_P.x() - 0.5 * arm.x() * 6e3 * g;
    ASSERT_NEAR(moment, 0, 1e-6 * arm.norm() * force_on_tie_P.norm());
    ASSERT_NEAR(force_on_tie_P.y(), 0, 1e-3);
    ASSERT_GT(force_on_tie_P.dot(Vector3(arm.x(), 0, arm.y())), 0);  // the tie pulls
  }
}

TEST_F(LevelLuffing, KeepsLoopsClosedAndEnergyInMotion) {
  const dynamics::History& moving = run().dynamic_history();
  EXPECT_LT(moving.loop("C1.tie_pin").residual.maxCoeff(), 1e-10);
  const double turned_over = moving.energy.drive_work.cwiseAbs().maxCoeff();
  EXPECT_LT(energy_imbalance(moving.energy).cwiseAbs().maxCoeff(), 1e-5 * turned_over);
}

// Of head, tower, hook (3) and load (6) the loop ties two together: nine motions, two eigenvalues
// each, but for the load's yaw below its one hook, which is neutral and counts once. The slowest is
// the load's swing.
TEST_F(LevelLuffing, HasNaturalModesOfWhatTheLoopLeavesFree) {
  ASSERT_FALSE(run().natural_modes.empty());
  for (const NaturalModes& modes : run().natural_modes) {
    int eigenvalues = 0, neutral = 0;
    double slowest = 0;
    for (const dynamics::Mode& mode : modes.linearisation.modes) {
      const bool swings = mode.kind == dynamics::ModeKind::oscillating;
      eigenvalues += swings ? 2 : 1;
      neutral += mode.kind == dynamics::ModeKind::neutral ? 1 : 0;
      if (swings) slowest = std::max(slowest, mode.period());
    }
    EXPECT_EQ(neutral, 1) << modes.instant;
    EXPECT_EQ(eigenvalues, 2 * 9 - 1) << modes.instant;
    EXPECT_GT(slowest, 2 * std::numbers::pi * std::sqrt(20 / g)) << modes.instant;
    EXPECT_LT(slowest, 2 * std::numbers::pi * std::sqrt(30 / g)) << modes.instant;
  }
}

TEST_F(LevelLuffing, WritesWhatTheLoopBears) {
  const TemporaryFolder folder;
  {
    ResultsWriter file("results.h5");
    write_loops(file, "/dynamic", run().model.system, run().dynamic_history());
    file.finish();
  }
  const ResultsReader results("results.h5");
  const Array<double> force = results.read("/dynamic/loops/C1.tie_pin/force");
  const Array<double> multipliers = results.read("/dynamic/loops/C1.tie_pin/multipliers");
  ASSERT_EQ(force.rows(), static_cast<std::size_t>(run().dynamic_history().sample_count()));
  EXPECT_EQ(force.columns(), 6U);
  EXPECT_EQ(multipliers.columns(), 2U);
  EXPECT_NEAR(std::hypot(force(0, 3), force(0, 4), force(0, 5)),
              std::hypot(multipliers(0, 0), multipliers(0, 1)), 1e-6);
  EXPECT_EQ(results.read_text_attribute("/dynamic/loops/C1.tie_pin", "kind"), "point_on_line");

  const auto rows = loops_json(run());
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["name"], "C1.tie_pin");
  EXPECT_DOUBLE_EQ(
      rows[0]["max_dynamic_load_N"].get<double>(),
      loop_load(run().model.system.mechanism().loops()[0], run().dynamic_history().loops[0])
          .maxCoeff());
  EXPECT_GT(rows[0]["max_static_load_N"].get<double>(), 100e3);
  EXPECT_TRUE(check_equalisers(run(), 0).empty());
}

/// The sample's gantry with its two sheaves hung from an equaliser rope that runs over the trolley.
test::SampleLift lift_with_equaliser() {
  test::SampleLift lift;
  lift.crane =
      with(lift.crane, "joints:\n",
           "  left_block: {mass: 200 kg, radii_of_gyration: [0.3 m, 0.3 m, 0.3 m]}\n"
           "  right_block: {mass: 200 kg, radii_of_gyration: [0.3 m, 0.3 m, 0.3 m]}\njoints:\n"
           "  left_block: {kind: prismatic, parent: trolley, child: left_block, axis: [0, 0, 1],"
           " position: [-2 m, 0 m, 0 m]}\n"
           "  right_block: {kind: prismatic, parent: trolley, child: right_block,"
           " axis: [0, 0, 1], position: [2 m, 0 m, 0 m]}\n");
  lift.crane = with(lift.crane, "drives:\n",
                    "loops:\n  equaliser:\n    kind: rope_length\n    paths:\n"
                    "      - [{body: left_block}, {body: trolley, position: [-2 m, 0 m, 2 m]},"
                    " {body: trolley, position: [2 m, 0 m, 2 m]}, {body: right_block}]\ndrives:\n");
  lift.crane = with(lift.crane, "    body: trolley\n    sheave: [-2 m, 0 m, 0 m]\n",
                    "    body: left_block\n    sheave: [0 m, 0 m, 0 m]\n");
  lift.crane = with(lift.crane, "    body: trolley\n    sheave: [2 m, 0 m, 0 m]\n",
                    "    body: right_block\n    sheave: [0 m, 0 m, 0 m]\n");
  return lift;
}

// The rope gives both sheaves the same pull, so that the load, whose mass is 50 mm off the middle
// of its lugs and 0.7 m below them, hangs tilted with its mass plumb below their middle.
TEST(Equaliser, GivesBothTacklesTheSameLoad) {
  const TemporaryFolder folder;
  lift_with_equaliser().write(folder);
  const LoadMass load{10e3, {2.05, 0, 0.5}, Vector3(5, 17, 20).asDiagonal() * (10e3 / 12)};
  const LiftRun lift = run_quietly(read_lift_case("case.yaml"), load);
  const dynamics::History& rest = lift.static_history;
  const Eigen::VectorXd rope =
      loop_load(lift.model.system.mechanism().loops()[0], rest.loop("C1.equaliser"));
  for (Eigen::Index i = 0; i < rest.sample_count(); ++i) {
    ASSERT_NEAR(rest.rope("C1.left").tension[i], (5000 + 500) * g, 1);
    ASSERT_NEAR(rest.rope("C1.right").tension[i], (5000 + 500) * g, 1);
    ASSERT_NEAR(rope[i], (5000 + 500 + 200) * g, 1);
    const Vector3 along = rest.body("load").X_WB(i).R.col(0);
    ASSERT_NEAR(std::atan2(-along.z(), along.x()), std::atan(0.05 / 0.7), 2e-3);
  }
  // The length that the file leaves open follows from the pose: 2 + 4 + 2 m.
  EXPECT_DOUBLE_EQ(lift.model.system.mechanism().loops()[0].length, 8);
  const std::vector<Check> checks = check_equalisers(lift, 1000);
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].name, "slack: smallest tension of equaliser C1.equaliser");
  EXPECT_TRUE(checks[0].pass);
  EXPECT_GT(checks[0].demand, 50e3);
  EXPECT_FALSE(check_equalisers(lift, 100e3)[0].pass);
  const auto rows = loops_json(lift);
  EXPECT_NEAR(rows[0]["min_static_tension_N"].get<double>(), 5700 * g, 1);
}

}  // namespace
}  // namespace blocklift::pipeline
