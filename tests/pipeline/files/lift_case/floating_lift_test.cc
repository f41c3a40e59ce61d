// Lifts by cranes on vessels, of vessels.
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

// A crane on a vessel lifts a vessel.
constexpr auto boat = R"(kind: vessel
hull: {barge: {length: 16 m, breadth: 8 m, depth: 4 m}}
panel_size: 2 m
mass: 80 t
centre_of_mass: [0 m, 0 m, 2 m]
radii_of_gyration: [3 m, 5 m, 5 m]
)";
const std::string lift_of_boat = R"(case: boat
gravity: 9.81 m/s^2
sea: {}
vessels: {B1: {model: vessels/barge, radiation: none, damping: {surge: 20 kN s/m, sway: 20 kN s/m, yaw: 2 MN m s/rad}}}
cranes: {F1: {model: crane, base: B1, start: {luffing: 60 deg, main: 15 m}}}
load: {vessel: vessels/boat, lugs: {L1: [-3 m, 0 m, 4 m], L2: [3 m, 0 m, 4 m]}, position: [30 m, 0 m, 7 m]}
ropes:
  R1: {from: F1.main, to: L1, model: {axial_stiffness: 50 MN, breaking_load: 500 t}, length: 10 m}
  R2: {from: F1.main, to: L2, model: {axial_stiffness: 50 MN, breaking_load: 500 t}, length: 10 m}
operation:
  - stage: lower
    moves: [{drives: [F1.main], by: 2 m}]
settle: 2 s
)";

std::string lift_complaints(const std::string& text, std::optional<LiftCase>& lift_case) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : {std::pair{"vessels/barge.yaml", test::sample_barge.c_str()},
                                      {"crane.yaml", test::sample_boom.c_str()},
                                      {"vessels/boat.yaml", boat}}) {
    folder.write(name, content);
  }
  folder.write("case.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary library({});
  lift_case = read_lift_case("case.yaml", library, diagnostics);
  return diagnostics.to_text();
}

TEST(MarineParts, AFloatingCraneHeelsUnderItsLoad) {
  std::optional<LiftCase> lift_case;
  ASSERT_EQ(lift_complaints(lift_of_boat, lift_case), "");
  EXPECT_FALSE(lift_case->has_structure());
  const BuiltLift built = build_lift(*lift_case, load_mass(lift_case->load.vessel->model));
  const dynamics::Mechanism& mechanism = built.system.mechanism();
  const dynamics::BodyIndex base = mechanism.body_index("B1");
  EXPECT_EQ(mechanism.body(mechanism.body_index("F1.boom")).parent, base);
  dynamics::EquilibriumSolver solver(built.at_rest());
  Eigen::VectorXd q = built.system.q_start();
  solver.solve(0, q);
  // All weight is borne by the water: rigid bodies in equilibrium.
  const auto& loads = solver.workspace().loads.F_Bo_W;
  double lift_force = 0;
  const dynamics::MotionState state{0, q, Eigen::VectorXd::Zero(mechanism.nv()),
                                    solver.workspace().kinematics};
  for (const auto& hull : std::get<std::vector<dynamics::HullForce>>(built.at_rest().elements())) {
    lift_force += hull.calc_force(state).force.z();
  }
  const double weight = 9.81 * (1640e3 + 41e3 + 2e3 + 80e3);
  EXPECT_NEAR(lift_force, weight, 1e-6 * weight);
  EXPECT_EQ(loads.size(), 5U);
  // The bow goes down: moment of load, hook and boom over the longitudinal stiffness.
  const Vector3 forward = solver.workspace().kinematics.X_WB[base].R.col(0);
  const double moment = 9.81 * (82e3 * (10 + 40 * std::cos(std::numbers::pi / 3)) +
                                41e3 * (10 + 10 * std::cos(std::numbers::pi / 3)));
  const double GM = 40.0 * 40.0 / 12 / 2.05 - 5;  // about, m
  const double trim = moment / (weight * GM);
  EXPECT_NEAR(-forward.z(), trim, 0.1 * trim);
}

TEST(MarineParts, ComplainsAboutFloatingCranes) {
  std::optional<LiftCase> ignored;
  const auto about = [&](const std::string& a, const std::string& b) {
    return lift_complaints(with(lift_of_boat, a, b), ignored);
  };
  EXPECT_THAT(about("base: B1", "base: B3"),
              HasSubstr("crane F1 stands on vessel \"B3\", which the case does not have"));
  EXPECT_THAT(about("to: L1", "to: L7"), HasSubstr("its lugs are L1, L2"));
  EXPECT_THAT(about("vessel: vessels/boat", "vessel: vessels/boat, model: x"),
              HasSubstr("a block's lugs stand in its model file"));
  EXPECT_THAT(about("sea: {}\n", ""), HasSubstr("vessel B1 floats in no sea"));
}

// A load with draughts is one more body in the water of the vessels, where it is to be lowered.
TEST(MarineParts, LoweredLoadSharesTheWaterOfTheVessels) {
  const std::string text =
      with(with(lift_of_boat, "radiation: none, ", ""), "lugs: {L1",
           "draughts: [0.4 m, 0.7 m], afloat: {position: [35 m, 3 m], heading: 90 deg}, lugs: {L1");
  std::optional<LiftCase> lift_case;
  ASSERT_EQ(lift_complaints(text, lift_case), "");
  const RadiationProblem problem = radiation_problem(*lift_case);
  ASSERT_EQ(problem.bodies.size(), 2U);
  ASSERT_TRUE(problem.lowered);
  EXPECT_EQ(problem.lowered->body, 1U);
  EXPECT_EQ(problem.bodies[1].name, "load");
  // B1 alone is the middle.
  EXPECT_LT((problem.bodies[1].X_DB.p - Vector3(35, 3, -0.7)).norm(), 1e-12);
  EXPECT_NEAR(problem.bodies[1].X_DB.R(1, 0), 1, 1e-12);
  EXPECT_EQ(without_lowered(problem).bodies.size(), 1U);
  const PanelProblem shallow = at_draught(problem, 0.4);
  EXPECT_NEAR(shallow.bodies[1].X_DB.p.z(), -0.4, 1e-12);

  dynamics::HydrodynamicSeries series{1, {0.0, 0.4, 0.7}, {}};
  for (int k = 0; k < 3; ++k) {
    dynamics::HydrodynamicDatabase database;
    database.water = problem.water;
    database.body_names = {"B1", "load"};
    database.infinite_added_mass = 1e6 * Eigen::MatrixXd::Identity(12, 12);
    if (k == 0) database.infinite_added_mass.bottomRows(6).setZero();
    database.time_step = 0.2;
    database.retardation.assign(20, Eigen::MatrixXd::Zero(12, 12));
    series.databases.push_back(std::move(database));
  }
  const BuiltLift built = build_lift(*lift_case, load_mass(lift_case->load.vessel->model), &series);
  ASSERT_TRUE(built.system.water());
  EXPECT_TRUE(built.system.water()->varies());
  EXPECT_EQ(built.system.water()->frames()[1].body, built.load);
  // She hangs dry with her keel 7 m above the water.
  dynamics::LiftWorkspace w(built.system);
  w.q = built.system.q_start();
  dynamics::calc_loads(built.system, 0, nullptr, w);
  EXPECT_EQ(w.water_shares.weight[0], 1);
  EXPECT_EQ(w.added()->matrix.bottomRows(6).norm(), 0);
  // What is lowered floats nowhere: no motions of free vessels are made of such a problem.
  lift_case->vessels[0].drift.value = DriftMethod::newman;
  EXPECT_FALSE(radiation_problem(*lift_case).drifting);
}

TEST(MarineParts, ComplainsAboutDraughts) {
  std::optional<LiftCase> ignored;
  const auto about = [&](const std::string& load, const std::string& radiation = "database") {
    return lift_complaints(with(with(lift_of_boat, "radiation: none", "radiation: " + radiation),
                                "lugs: {L1", load + ", lugs: {L1"),
                           ignored);
  };
  EXPECT_THAT(about("draughts: [0.5 m, 4 m]"),
              HasSubstr("case.yaml:6:40: error: the deepest draught of the load is 4 m, and its "
                        "hull is 4 m deep"));
  EXPECT_THAT(about("draughts: [0.5 m, 0.3 m]"), HasSubstr("draughts must ascend"));
  EXPECT_THAT(about("draughts: [0.5 m]", "direct"),
              HasSubstr("the load has draughts, and the radiation of vessel B1 is direct"));
  EXPECT_THAT(about("draughts: [0.5 m]", "database, draughts: [2 m]"),
              HasSubstr("the load has draughts, as vessel B1 has"));
  EXPECT_THAT(about("draughts: [0.5 m]", "none, draughts: [2 m]"),
              HasSubstr("vessel B1 has draughts, and its radiation is none"));
  EXPECT_THAT(about("afloat: {position: [30 m, 0 m]}"),
              HasSubstr("afloat is the place for which draughts are computed"));
  EXPECT_THAT(about("draughts: [0.5 m], afloat: {position: [10 m, 0 m]}"),
              HasSubstr("the load in the water intersect"));
}

}  // namespace
}  // namespace blocklift::pipeline
