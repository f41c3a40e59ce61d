#include "pipeline/build/build_lift.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"
#include "pipeline/build/describe_block.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::SampleLift;
using test::TemporaryFolder;
using test::with;

/// The sample's plate as a box of 4 x 2 x 1 m about its centre of mass.
LoadMass sample_mass() {
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(1 + 4, 1 + 16, 16 + 4).asDiagonal() * (10e3 / 12.0);
  return load;
}

BuiltLift build_sample(const SampleLift& lift = {}) {
  const TemporaryFolder folder;
  lift.write(folder);
  return build_lift(read_lift_case("case.yaml"), sample_mass());
}

/// Tension of the named rope in the solver's last solution, N.
double tension(dynamics::EquilibriumSolver& solver, const BuiltLift& lift,
               const std::string& rope) {
  const auto index = static_cast<std::size_t>(lift.system.rope_index(rope));
  return solver.workspace().rope_loads[index].tension;
}

// Nothing but the air turns what hangs on one hook: its heading is held at rest. Two hooks or a
// tugger turn it themselves.
TEST(BuildLiftTest, HoldsTheHeadingOfALoadOnOneHook) {
  EXPECT_FALSE(build_sample().held_heading);
  SampleLift one;
  one.lift_case = with(one.lift_case, "R2: {from: C1.right", "R2: {from: C1.left");
  const BuiltLift held = build_sample(one);
  ASSERT_TRUE(held.held_heading);
  EXPECT_EQ(held.held_heading->body, held.load);
  EXPECT_TRUE(held.held_heading->R_WB.isIdentity());
  SampleLift pulled = one;
  pulled.lift_case = with(pulled.lift_case, "operation:",
                          "tuggers:\n  T1: {from: {body: world, position: [-9 m, 0 m, 2 m]}, to: "
                          "{body: load, position: [0 m, 0 m, 0 m]}, tension: 1 kN}\noperation:");
  EXPECT_FALSE(build_sample(pulled).held_heading);
}

TEST(BuildLiftTest, NamesAndPlacesTheParts) {
  const BuiltLift lift = build_sample();
  const dynamics::Mechanism& mechanism = lift.system.mechanism();
  for (const char* body : {"C1.gantry", "C1.trolley", "C1.left", "C1.right", "load"}) {
    EXPECT_TRUE(mechanism.has_body(body)) << body;
  }
  EXPECT_EQ(mechanism.body(mechanism.body_index("C1.trolley")).parent,
            mechanism.body_index("C1.gantry"));
  EXPECT_EQ(mechanism.driven_velocities().size(), 2U);
  EXPECT_EQ(lift.system.nv_free(), 3 + 3 + 6);
  EXPECT_DOUBLE_EQ(mechanism.gravity().z(), -9.81);
  ASSERT_EQ(lift.hoists.size(), 2U);
  EXPECT_EQ(lift.hoists[1].name, "C1.right");
  EXPECT_DOUBLE_EQ(lift.hoists[1].capacity, 10e3 * 9.80665);
  ASSERT_EQ(lift.ropes.size(), 2U);
  EXPECT_EQ(lift.ropes[0].lug, "L1");
  EXPECT_EQ(lift.ropes[0].hoist, "C1.left");
  EXPECT_EQ(lift.system.operation().stages().size(), 2U);
  EXPECT_EQ(lift.system.operation().winches().size(), 2U);
  // The load is drawn as the box around its plates: 4 x 2 x 1 m.
  const std::vector<BoxShape>& drawn = lift.bodies.back().boxes;
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].size, Vector3(4, 2, 1));
  EXPECT_EQ(drawn[0].centre, Vector3(2, 0, 0.5));
}

// Two equalised hooks carry alike, so a load whose centre of mass lies e beside their middle and h
// below its pins turns until it hangs below it: tan(tilt) = e / h. Slings lean in by two
// centimetres in seven metres then, which moves the tilt by less than a hundredth.
TEST(BuildLiftTest, EqualisedHoistsCarryAlike) {
  SampleLift parts;
  parts.crane = with(parts.crane, "rope: {axial_stiffness: 200 MN, breaking_load: 100 t}",
                     "rope: ropes/tackle");
  parts.lift_case =
      with(parts.lift_case, "model: gantry\n", "model: gantry\n    equalised: [left, right]\n");
  const TemporaryFolder folder;
  parts.write(folder);
  LoadMass mass = sample_mass();
  mass.p_BoBcm_B.x() = 2.1;
  const BuiltLift lift = build_lift(read_lift_case("case.yaml"), mass);
  ASSERT_EQ(lift.hoists.size(), 2U);
  EXPECT_EQ(lift.hoists[0].rope, lift.hoists[1].rope);
  EXPECT_TRUE(lift.hoists[0].hook_is_first);
  EXPECT_EQ(lift.system.operation().winches().size(), 2U);

  dynamics::EquilibriumSolver solver(lift.system);
  Eigen::VectorXd q = lift.system.q_start();
  solver.solve(0, q);
  const double weight = 10e3 * 9.81;
  EXPECT_NEAR(tension(solver, lift, "C1.left and C1.right"), weight / 2 + 500 * 9.81, 20);
  const dynamics::Pose& X_WB = solver.workspace().kinematics.X_WB[lift.load];
  EXPECT_NEAR(std::asin(-X_WB.R(2, 0)), std::atan(0.1 / 0.7), 0.01 * 0.1 / 0.7);
  // Both tackles together stretch by the rope's T (L1 + L2) / EA and by what the left one hangs
  // from, T / k; the hooks' mean is below the sheaves by the half of it.
  const double tackles = solver.workspace().rope_loads[0].length;
  const double load = weight / 2 + 500 * 9.81;
  EXPECT_NEAR(tackles, 10 + load * 10 / 200e6 + load / 10e6, 2e-5);
}

// Slings and the left tackle with a curve of tension, given as shares of the breaking load: they
// stretch by the curve at what they carry.
TEST(BuildLiftTest, RopesStretchByTheirCurves) {
  SampleLift parts;
  parts.rope = with(parts.rope, "axial_stiffness: 200 MN\n",
                    "tension_curve: [[0 %, 0 %], [1 %, 2 %], [2 %, 8 %]]\n");
  const BuiltLift lift = build_sample(parts);
  dynamics::EquilibriumSolver solver(lift.system);
  Eigen::VectorXd q = lift.system.q_start();
  solver.solve(0, q);
  const dynamics::TensionLaw law({{0, 0}, {0.01, 20e3}, {0.02, 80e3}});
  for (const char* rope : {"R1", "R2"}) {
    const auto index = static_cast<std::size_t>(lift.system.rope_index(rope));
    const dynamics::RopeLoad& load = solver.workspace().rope_loads[index];
    EXPECT_NEAR(load.tension, 5e3 * 9.81, 1e3);
    EXPECT_NEAR(load.elongation(), 2 * law.find_strain(load.tension), 1e-12);
  }
  const dynamics::RopeLoad& tackle =
      solver.workspace().rope_loads[lift.system.rope_index("C1.left")];
  EXPECT_NEAR(tackle.elongation(), 5 * law.find_strain(tackle.tension) + tackle.tension / 10e6,
              1e-12);
}

// Each sling carries half of the load but for a tilt: the crane gives way under the left tackle
// only, by T/k, and the centre of mass hangs 0.7 m below the pins, so that the left sling carries W
// 0.7 tilt / 4 m less.
TEST(BuildLiftTest, HangsInEquilibrium) {
  const BuiltLift lift = build_sample();
  dynamics::EquilibriumSolver solver(lift.system);
  Eigen::VectorXd q = lift.system.q_start();
  solver.solve(0, q);
  const double weight = 10e3 * 9.81;
  const double tilt = 5500 * 9.81 / 10e6 / 4;
  const double shift = weight * 0.7 * tilt / 4;
  EXPECT_NEAR(tension(solver, lift, "R1"), weight / 2 - shift, 0.1);
  EXPECT_NEAR(tension(solver, lift, "R2"), weight / 2 + shift, 0.1);
  EXPECT_NEAR(tension(solver, lift, "C1.left"), weight / 2 - shift + 500 * 9.81, 0.1);
  // Lugs 4 m apart hang plumb below sheaves 4 m apart: 10 m less 5 m tackle, 2 m sling, their
  // stretch, and 1.2 m from the pin down to the block's origin.
  const double tackle = 5 + 5500 * 9.81 * (5 / 200e6 + 1 / 10e6);
  const double sling = 2 + 5000 * 9.81 * (2 / 200e6);
  const Vector3 p_WB = solver.workspace().kinematics.X_WB[lift.load].p;
  EXPECT_NEAR(p_WB.x(), -2, 1e-2);
  EXPECT_NEAR(p_WB.y(), 5, 1e-6);
  EXPECT_NEAR(p_WB.z(), 10 - tackle - sling - 1.2, 1e-2);
}

TEST(BuildLiftTest, FollowsTheOperation) {
  const BuiltLift lift = build_sample();
  const double end = lift.system.operation().duration();
  EXPECT_DOUBLE_EQ(end, lift.schedule.duration);
  dynamics::LiftWorkspace workspace(lift.system);
  dynamics::set_drives(lift.system, end, true, workspace);
  const dynamics::Mechanism& mechanism = lift.system.mechanism();
  const auto coordinate = [&](const char* body) {
    return workspace.q[mechanism.body(mechanism.body_index(body)).q_offset];
  };
  EXPECT_NEAR(coordinate("C1.gantry"), 10, 1e-9);
  EXPECT_NEAR(coordinate("C1.trolley"), 5 + 2, 1e-9);
  const auto left = static_cast<std::size_t>(lift.system.rope_index("C1.left"));
  EXPECT_NEAR(workspace.feeds[left].unstretched_length, 3, 1e-9);
  EXPECT_EQ(lift.schedule.stages[0].start, 5);
}

TEST(BuildLiftTest, TurnsACraneWithItsBase) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, "model: gantry",
                        "model: gantry\n    position: [5 m, 7 m, 0 m]\n"
                        "    orientation: [0 deg, 0 deg, 90 deg]");
  const BuiltLift built = build_sample(lift);
  const dynamics::Mechanism& mechanism = built.system.mechanism();
  const int hook = mechanism.body(mechanism.body_index("C1.left")).q_offset;
  // Sheave at (-2, 5, 10) from the base, turned by a quarter: (-5, -2, 10); tackle 5 m long.
  EXPECT_TRUE(built.system.q_start().segment<3>(hook).isApprox(Vector3(0, 5, 5), 1e-12));
}

TEST(BuildLiftTest, TakesWindSupportsSheavesAndRopesWithWinches) {
  SampleLift lift;
  lift.lift_case =
      with(lift.lift_case, "operation:",
           "  tugger:\n"
           "    from: {body: world, point: [-10 m, 5 m, 1 m]}\n"
           "    through: [{body: C1.gantry, point: [-3 m, 5 m, 1 m]}]\n"
           "    sheave_efficiency: 90 %\n"
           "    to: {body: load, point: [0 m, 0 m, 0 m]}\n"
           "    model: {axial_stiffness: 1 MN, breaking_load: 10 t}\n"
           "    length: 9 m\n"
           "    winch: {speed: 6 m/min, acceleration: 0.1 m/s^2, jerk: 0.1 m/s^3, "
           "range: [1 m, 50 m]}\n"
           "supports:\n  P1: {point: [0 m, 0 m, 0 m], stiffness: 10 MN/m}\n"
           "wind: {speed: 10 m/s, towards: 90 deg}\n"
           "operation:\n  - stage: pay out\n    moves: [{drives: [tugger], to: 20 m}]\n");
  const BuiltLift built = build_sample(lift);
  EXPECT_EQ(std::get<std::vector<dynamics::WindArea>>(built.system.elements()).size(), 2U);
  ASSERT_EQ(built.system.supports().size(), 1U);
  const auto& pad = built.system.supports()[0].definition();
  EXPECT_TRUE(pad.p_WG.isApprox(Vector3(-2, 5, 0)));
  const auto& tugger = built.system.ropes()[built.system.rope_index("tugger")];
  ASSERT_EQ(tugger.points().size(), 3U);
  EXPECT_EQ(tugger.points()[0].body, dynamics::world_index);
  EXPECT_EQ(tugger.points()[2].body, built.load);
  // Over half a turn 90 % are left.
  EXPECT_NEAR(std::exp(-tugger.definition().sheave_friction * 3.14159265358979), 0.9, 1e-12);
  EXPECT_EQ(built.system.operation().winches().size(), 3U);
}

TEST(BuildLiftTest, RefusesALoadTable) {
  const TemporaryFolder folder;
  SampleLift lift;
  lift.lift_case = test::sample_load_table_case;
  lift.write(folder);
  EXPECT_THROW(build_lift(read_lift_case("case.yaml"), sample_mass()), std::invalid_argument);
}

TEST(DescribeBlockTest, CarriesEveryPart) {
  const TemporaryFolder folder;
  SampleLift().write(folder);
  const LiftCase lift = read_lift_case("case.yaml");
  const structure::BlockDescription block = describe_block(*lift.load.model, "plate", 0.5);
  EXPECT_DOUBLE_EQ(block.largest_element, 0.5);
  EXPECT_DOUBLE_EQ(*block.total_mass, 10e3);
  ASSERT_EQ(block.plates.size(), 2U);
  EXPECT_EQ(block.plates[1].normal, structure::Axis::x);
  EXPECT_EQ(block.plates[1].positions, (std::vector<double>{0, 2, 4}));
  EXPECT_DOUBLE_EQ(block.plates[1].extent[2].upper, 1);
  EXPECT_EQ(block.plates[0].material, "steel");
  ASSERT_EQ(block.openings.size(), 1U);
  EXPECT_EQ(block.openings[0].positions, std::vector<double>{2});
  ASSERT_EQ(block.lugs.size(), 2U);
  EXPECT_EQ(block.lugs[1].pad, "right_pad");
  EXPECT_DOUBLE_EQ(block.lugs[1].p_BPin.z(), 1.2);
}

}  // namespace
}  // namespace blocklift::pipeline
