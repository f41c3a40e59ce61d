// Hook blocks that turn, from files: what the falls do to them by statics, measures, checks,
// doubts.
#include "pipeline/measures/hook_block_measures.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/measure_checks.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

constexpr double radian = std::numbers::pi / 180;

const std::string pulls_aside =
    "tuggers:\n  T1: {from: {body: world, position: [0 m, 400 m, 3 m]}, to: {body: load, "
    "position: [4 m, 0 m, 0.5 m]}, tension: 1 kN}\n";

/// The sample's plate on one hook with two horns, drawn aside at one end by a tugger that holds 1
/// kN.
struct TurningLift {
  explicit TurningLift(const std::string& turning, const std::string& checks = "{}",
                       const std::string& tugger = pulls_aside) {
    test::SampleLift files;
    files.crane = test::with(files.crane, "{mass: 500 kg, wind_area: 1 m^2}",
                             "{mass: 500 kg, turning: {" + turning + "}}");
    files.lift_case = R"(case: one-hook
gravity: 9.81 m/s^2
load: {model: plate, position: [-4 m, 5 m, 2 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 5 m, right: 2 m}
ropes:
  R1: {from: C1.left.b, to: L1, model: ropes/tackle, length: 2.6 m}
  R2: {from: C1.left.a, to: L2, model: ropes/tackle, length: 2.6 m}
)" + tugger + R"(operation:
  - stage: hoist up
    moves:
      - {drives: [C1.left], by: -1 m}
checks: )" + checks + "\n";
    const test::TemporaryFolder folder;
    files.write(folder);
    lift_case = read_lift_case("case.yaml");
    LoadMass load;
    load.mass = 10e3;
    load.p_BoBcm_B = {2, 0, 0.5};
    load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
    run.emplace(run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {}));
    measures = find_measures(lift_case, *run);
  }

  const LiftMeasure& measure(const std::string& name) const {
    for (const LiftMeasure& one : measures)
      if (one.name() == name) return one;
    throw std::out_of_range(name);
  }

  LiftCase lift_case;
  std::optional<LiftRun> run;
  std::vector<LiftMeasure> measures;
};

const std::string locked = "falls_apart: 1.2 m, radius_of_gyration: 0.4 m, horns: 0.5 m";

// The falls' moment is that of the tugger about the hook, and T b^2 sin(theta) / L of the twist,
// which leaves a little to the lean of the falls. The load turns further, by the slings.
TEST(HookBlockMeasures, FallsBearTheMomentOfATugger) {
  const TurningLift lift(locked);
  const dynamics::History& history = lift.run->static_history;
  const auto pose = [&](const char* body) {
    return history
        .bodies[static_cast<std::size_t>(lift.run->model.system.mechanism().body_index(body)) - 1]
        .X_WB(0);
  };
  const Vector3 hook = pose("C1.left").p, end = pose("load").apply({4, 0, 0.5});
  const Vector3 pull = 1e3 * (Vector3(0, 400, 3) - end).normalized();
  const double moment = (end - hook).cross(pull).z();
  EXPECT_GT(moment, 1.5e3);
  EXPECT_NEAR(lift.measure("C1.left: moment of falls").at_rest[0], -moment, 1e-5 * moment);

  const dynamics::RopeHistory& tackle = history.rope("C1.left");
  const double twist = lift.measure("C1.left: twist of falls").at_rest[0];
  const double length = tackle.unstretched_length[0] + tackle.elongation[0];
  EXPECT_NEAR(tackle.tension[0] * 0.36 * std::sin(twist) / length, moment, 2e-3 * moment);
  const auto yaw = [&](const char* body) {
    return std::atan2(pose(body).R(1, 0), pose(body).R(0, 0));
  };
  EXPECT_NEAR(twist, yaw("C1.left"), 1e-9);
  EXPECT_GT(yaw("load"), twist + 0.02);
  // Two falls and one hook are drawn, measured and held like others.
  EXPECT_NEAR(tackle.last_force(0, 2), 10.5e3 * 9.81, 1e-2 * 10.5e3 * 9.81);
}

TEST(HookBlockMeasures, TwistIsHeldAgainstItsLimit) {
  const TurningLift lift(locked, "{falls_twist: 10 deg}");
  bool found = false;
  for (const Check& check : check_measures(lift.lift_case, *lift.run, lift.measures)) {
    if (check.name.find("twist of falls") == std::string::npos) continue;
    found = true;
    EXPECT_NEAR(check.limit, 10 * radian, 1e-12);
    EXPECT_FALSE(check.pass);
    EXPECT_EQ(check.note, "C1.left");
  }
  EXPECT_TRUE(found);
}

// On a bearing the load hangs as it was put, with friction or without, and nothing twists the
// falls.
TEST(HookBlockMeasures, HookTurnsOnItsBearing) {
  for (const char* friction : {"0 N m", "500 N m"}) {
    const TurningLift lift(locked +
                               ", towards: 20 deg, bearing: {hook_mass: 100 kg, "
                               "radius_of_gyration: 0.2 m, friction_moment: " +
                               friction + "}",
                           "{}", "");
    EXPECT_LT(lift.measure("C1.left: twist of falls").in_motion.cwiseAbs().maxCoeff(), 1e-3);
    // The slings turn the horns, which were put aslant, to where they lie in their plane.
    const LiftMeasure& turn = lift.measure("C1.left: turn on the bearing");
    EXPECT_EQ(turn.unit, "rad");
    const dynamics::History& history = lift.run->static_history;
    const auto yaw = [&](const char* body) {
      const auto index = lift.run->model.system.mechanism().body_index(body);
      const Eigen::Matrix3d R = history.bodies[static_cast<std::size_t>(index) - 1].X_WB(0).R;
      return std::atan2(R(1, 0), R(0, 0));
    };
    EXPECT_NEAR(yaw("C1.left"), yaw("load"), 1e-6);
    EXPECT_NEAR(turn.at_rest[0], yaw("C1.left") - 20 * radian, 1e-6);
    EXPECT_LT((turn.in_motion.array() - turn.in_motion[0]).abs().maxCoeff(), 1e-2);
  }
}

TEST(HookBlockMeasures, TwistGoesOnBeyondATurn) {
  TurningLift lift(locked);
  dynamics::History& history = lift.run->dynamic_result.history;
  const auto block =
      static_cast<std::size_t>(lift.run->model.system.mechanism().body_index("C1.left")) - 1;
  const Eigen::Index samples = history.sample_count();
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double yaw = 400 * radian * static_cast<double>(i) / static_cast<double>(samples - 1);
    history.bodies[block].pose.row(i).tail<4>() << std::cos(yaw / 2), 0, 0, std::sin(yaw / 2);
  }
  const LiftHoist& hoist = lift.run->model.hoists.front();
  EXPECT_TRUE(block_turns(*lift.run, hoist));
  EXPECT_FALSE(block_turns(*lift.run, lift.run->model.hoists.back()));
  EXPECT_NEAR(falls_twist(*lift.run, hoist, history)[samples - 1], 400 * radian, 1e-9);
}

}  // namespace
}  // namespace blocklift::pipeline
