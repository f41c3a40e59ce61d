// A floating crane loses its load: heel and freeboard of its vessel.
#include "pipeline/measures/vessel_measures.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "pipeline/build/build_lift.h"
#include "pipeline/checks/lost_load.h"
#include "pipeline/checks/measure_checks.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

constexpr auto barge = R"(kind: vessel
hull: {barge: {length: 60 m, breadth: 24 m, depth: 6 m}}
panel_size: 6 m
mass: 3000 t
centre_of_mass: [0 m, 0 m, 4 m]
radii_of_gyration: [8 m, 17 m, 17 m]
)";

constexpr auto boat = R"(kind: vessel
hull: {barge: {length: 16 m, breadth: 8 m, depth: 4 m}}
panel_size: 2 m
mass: 80 t
centre_of_mass: [0 m, 0 m, 2 m]
radii_of_gyration: [3 m, 5 m, 5 m]
)";

// The crane stands across the barge, its boom over the starboard side.
const std::string lift_text = R"(case: lost
gravity: 9.81 m/s^2
sea: {}
vessels: {B1: {model: vessels/barge, radiation: none}}
cranes: {F1: {model: crane, base: B1, position: [0 m, 0 m, 0 m], orientation: [0 deg, 0 deg, -90 deg], start: {luffing: 60 deg, main: 15 m}}}
load: {vessel: vessels/boat, lugs: {L1: [-3 m, 0 m, 4 m], L2: [3 m, 0 m, 4 m]}, position: [0 m, -30 m, 7 m]}
ropes:
  R1: {from: F1.main, to: L1, model: {axial_stiffness: 50 MN, breaking_load: 500 t}, length: 10 m}
  R2: {from: F1.main, to: L2, model: {axial_stiffness: 50 MN, breaking_load: 500 t}, length: 10 m}
operation: [{stage: hold, pause: 20 s}]
settle: 4 s
faults: [{at: 1 s, parts: [F1.main]}]
checks: {heel: 15 deg, freeboard: 1 m}
)";

/// About its rest without the load it swings as far to the other side as it had leant to the load's
/// (hydrostatics alone, nothing damps).
TEST(VesselMeasures, AVesselHeelsToTheOtherSideWhenItsLoadIsLost) {
  const test::TemporaryFolder folder;
  folder.write("vessels/barge.yaml", barge);
  folder.write("vessels/boat.yaml", boat);
  folder.write("crane.yaml", test::sample_boom);
  folder.write("case.yaml", lift_text);
  const LiftCase lift_case = read_lift_case("case.yaml");
  const LiftRun run = run_lift(
      lift_case, build_lift(lift_case, load_mass(lift_case.load.vessel->model)), [](auto&&...) {},
      RunExtent{.natural_modes = false});
  std::vector<LiftMeasure> measures;
  add_vessel_measures(lift_case, run, measures);
  ASSERT_EQ(measures.size(), 3u);
  const LiftMeasure& heel = measures[0];
  EXPECT_EQ(heel.name(), "B1: heel");
  const double loaded = heel.at_rest[0];
  // To starboard, port up, by the load's moment over the vessel's stiffness in roll.
  EXPECT_GT(loaded, 0.005);
  // The boom leans to starboard, too, so that the rest without the load is not upright: it is the
  // mean of both extremes.
  const double other_side = heel.in_motion.minCoeff();
  const double moment = 80e3 * 9.81 * 30.0;
  const double draught = 3123e3 / (1025.0 * 60 * 24);
  const double metacentre = draught / 2 + 24.0 * 24.0 / (12 * draught);
  const double stiffness = 3123e3 * 9.81 * (metacentre - 4.4);
  EXPECT_NEAR(loaded - other_side, 2 * moment / stiffness, 0.15 * 2 * moment / stiffness);
  const LiftMeasure& freeboard = measures[2];
  EXPECT_NEAR(freeboard.at_rest[0], 6 - (3123e3 / (1025.0 * 60 * 24)) - 12 * std::sin(loaded), 0.3);

  bool heel_checked = false, freeboard_checked = false;
  for (const Check& check : check_measures(lift_case, run, measures)) {
    heel_checked |= check.name.starts_with("heel") && check.pass;
    freeboard_checked |= check.name.starts_with("freeboard") && check.pass;
  }
  EXPECT_TRUE(heel_checked && freeboard_checked);

  // The lift itself fails, for its load is lost; one that floats when it is let go is not.
  const std::optional<Check> lost = check_held(lift_case, run);
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->pass);
  EXPECT_EQ(lost->demand, 0);
  LiftRun launched = run;
  auto& pose =
      launched.dynamic_result.history.bodies[static_cast<std::size_t>(launched.model.load) - 1]
          .pose;
  pose.rightCols<5>().setZero();
  pose.col(3).setOnes();  // upright
  pose.col(2).setConstant(-80e3 / (1025.0 * 16 * 8));
  const std::optional<Check> afloat = check_held(lift_case, launched);
  ASSERT_TRUE(afloat);
  EXPECT_TRUE(afloat->pass);
  EXPECT_NEAR(afloat->demand, 1, 1e-6);
}

}  // namespace
}  // namespace blocklift::pipeline
