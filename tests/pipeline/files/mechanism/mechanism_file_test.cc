#include "pipeline/files/mechanism/mechanism_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/mechanism/urdf_import.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;
using test::with;
using ::testing::HasSubstr;

// A slider-crank with everything that may act on it.
const std::string sample = R"(mechanism: sample
gravity: [0 m/s^2, -9.81 m/s^2, 0 m/s^2]
parameters:
  crank: 1 m
  rod: = 3 * crank
bodies:
  crank: {mass: 2 kg, radii_of_gyration: [1 m, 1 m, 1 m]}
  rod: {mass: 3 kg, centre_of_mass: [= rod / 2, 0 m, 0 m], radii_of_gyration: [0.1 m, 1 m, 1 m]}
  slider: {mass: 1 kg, radii_of_gyration: [1 m, 1 m, 1 m], wind_areas: [{area: 2 m^2}]}
joints:
  shaft: {kind: revolute, child: crank}
  pin: {kind: revolute, parent: crank, child: rod, position: [= crank, 0 m, 0 m]}
  guide: {kind: prismatic, child: slider, axis: [1, 0, 0], damping: 1 N s/m}
loops:
  wrist: {kind: revolute, first: {body: rod, position: [= rod, 0 m, 0 m]}, second: {body: slider}}
springs:
  buffer: {kind: point, from: {body: slider}, to: {body: world, position: [6 m, 0 m, 0 m]}, stiffness: 10 N/m, free_length: 2 m}
  twist: {kind: joint, joint: pin, stiffness: 2 N m/rad, free_coordinate: 10 deg}
ropes:
  tie: {from: {body: crank}, to: {body: world, position: [0 m, 9 m, 0 m]}, model: {axial_stiffness: 1 kN}, length: 9 m}
forces:
  push: {body: slider, force_table: [[0 s, [0 N, 0 N, 0 N]], [1 s, [5 N, 0 N, 0 N]]]}
  motor: {joint: shaft, moment: 4 N m}
wind: {speed: 4 m/s, towards: 0 deg}
initial:
  positions: {shaft: 30 deg, pin: -40 deg, guide: 3.8 m}
  velocities: {shaft: 1 rad/s}
simulate: {duration: 1 s}
outputs:
  x: {joint: guide}
  wrist: {loop: wrist}
)";

std::optional<MechanismFile> read(const std::string& text, std::string& complaints) {
  const TemporaryFolder folder;
  folder.write("mechanism.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary library({});
  auto file = read_mechanism("mechanism.yaml", library, diagnostics);
  EXPECT_EQ(file.has_value(), !diagnostics.has_errors());
  complaints = diagnostics.to_text();
  return file;
}

std::string complaints_about(const std::string& old_passage, const std::string& new_passage) {
  std::string complaints;
  read(with(sample, old_passage, new_passage), complaints);
  return complaints;
}

TEST(MechanismFile, CarriesWhatTheFileSays) {
  std::string complaints;
  const auto file = read(sample, complaints);
  ASSERT_TRUE(file) << complaints;
  EXPECT_EQ(file->name, "sample");
  EXPECT_EQ(file->gravity, Vector3(0, -9.81, 0));
  EXPECT_DOUBLE_EQ(file->bodies[1].centre_of_mass.x(), 1.5);
  EXPECT_DOUBLE_EQ(file->loops[0].first->position->value.x(), 3);
  EXPECT_DOUBLE_EQ(file->sample_interval(), 0.002);
  EXPECT_DOUBLE_EQ(file->simulate.relative_tolerance, 1e-8);
}

TEST(MechanismFile, BuildsWhatTheFileSays) {
  std::string complaints;
  const auto file = read(sample, complaints);
  ASSERT_TRUE(file) << complaints;
  const BuiltMechanism built = build_mechanism(*file);
  const dynamics::LiftSystem& system = built.system;
  EXPECT_EQ(system.mechanism().body_count(), 4);
  EXPECT_EQ(system.mechanism().loops().size(), 1U);
  EXPECT_EQ(system.ropes().size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::PointSpring>>(system.elements()).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::JointSpring>>(system.elements()).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::WindArea>>(system.elements()).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::AppliedLoad>>(system.elements()).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::JointLoad>>(system.elements()).size(), 1U);
  // The rough start is closed: x = cos a + sqrt(9 - sin^2 a).
  const double a = system.q_start()[0];
  EXPECT_NEAR(system.q_start()[2], std::cos(a) + std::sqrt(9 - std::pow(std::sin(a), 2)), 1e-9);
  EXPECT_NEAR(a, std::acos(-1.0) / 6, 0.1);
}

TEST(MechanismFile, HoldsJointsWhileLoopsAreClosed) {
  std::string complaints;
  const auto file =
      read(with(sample, "  velocities:", "  held: [shaft]\n  velocities:"), complaints);
  ASSERT_TRUE(file) << complaints;
  const dynamics::LiftSystem system = build_mechanism(*file).system;
  EXPECT_NEAR(system.q_start()[0], std::acos(-1.0) / 6, 1e-14);
  EXPECT_NEAR(system.v_start()[0], 1.0, 1e-14);
}

TEST(MechanismFile, OpenLoopsAreAnErrorWhereTheyMustBeClosed) {
  EXPECT_THAT(complaints_about("  velocities:", "  assembly: as_given\n  velocities:"),
              HasSubstr("the loops are open at the start: loop \"wrist\" by"));
}

TEST(MechanismFile, LoopsThatCannotCloseAreAnError) {
  EXPECT_THAT(complaints_about("second: {body: slider}",
                               "second: {body: slider, position: [0 m, 9 m, 0 m]}"),
              HasSubstr("mechanism.yaml:1:1: error: "));
}

/// Potential energy of the sample at a crank angle a, by hand: x = cos a + sqrt(9 - sin^2 a), the
/// rod turned by b = -asin(sin(a) / 3). The tie hangs slack; wind (1.25 / 2 kg/m^3, 4 m/s, 2 m^2,
/// 1.2) and motor (4 N m) are constant.
double potential_by_hand(double a) {
  const double b = -std::asin(std::sin(a) / 3);
  const double x = std::cos(a) + std::sqrt(9 - std::pow(std::sin(a), 2));
  const double weight = 3 * 9.81 * 0.5 * std::sin(a);
  const double buffer = 0.5 * 10 * std::pow(6 - x - 2, 2);
  const double twist = 0.5 * 2 * std::pow(b - a - std::acos(-1.0) / 18, 2);
  return weight + buffer + twist - 4 * a - 0.5 * 1.25 * 16 * 2 * 1.2 * x;
}

TEST(MechanismFile, StartsFromTheEquilibriumOfAMechanismWithLoops) {
  std::string complaints;
  std::string text = with(sample, "  velocities: {shaft: 1 rad/s}\n", "");
  text = with(text, "duration: 1 s", "duration: 1 s, start: equilibrium");
  const auto file = read(text, complaints);
  ASSERT_TRUE(file) << complaints;
  const dynamics::LiftSystem system = build_mechanism(*file).system;
  Eigen::VectorXd q = system.q_start();
  dynamics::EquilibriumSolver(system).solve(0, q);
  const double a = q[0];
  const double slope = (potential_by_hand(a + 1e-5) - potential_by_hand(a - 1e-5)) / 2e-5;
  EXPECT_NEAR(slope, 0, 1e-6) << "at " << a;
  EXPECT_GT(potential_by_hand(a + 0.1), potential_by_hand(a));
  EXPECT_GT(potential_by_hand(a - 0.1), potential_by_hand(a));
  EXPECT_NEAR(q[2], std::cos(a) + std::sqrt(9 - std::pow(std::sin(a), 2)), 1e-10);
}

TEST(MechanismFile, SaysWhatDoesNotExist) {
  EXPECT_THAT(complaints_about("parent: crank, child: rod", "parent: crak, child: rod"),
              HasSubstr("joint pin joins body \"crak\", which the mechanism does not have\n"
                        "    its bodies are crank, rod, slider; did you mean \"crank\"?"));
  EXPECT_THAT(complaints_about("second: {body: slider}", "second: {body: slder}"),
              HasSubstr("loop wrist names body \"slder\", which the mechanism does not have"));
  EXPECT_THAT(complaints_about("joint: pin, stiff", "joint: pim, stiff"),
              HasSubstr("spring twist names joint \"pim\""));
  EXPECT_THAT(complaints_about("{loop: wrist}", "{loop: wrst}"),
              HasSubstr("output wrist names loop \"wrst\", which the mechanism does not have\n"
                        "    its loops are wrist; did you mean \"wrist\"?"));
  EXPECT_THAT(complaints_about("positions: {shaft", "positions: {shft"),
              HasSubstr("the initial state names joint \"shft\""));
  EXPECT_THAT(complaints_about("body: slider, force_table", "body: sledge, force_table"),
              HasSubstr("force push names body \"sledge\""));
}

TEST(MechanismFile, SaysAllErrorsAtOnce) {
  std::string text = with(sample, "mass: 2 kg", "mass: 2 m");
  text = with(text, "joint: shaft, moment: 4 N m", "joint: shaft, moment: [4 N m, 0 N m]");
  text = with(text, "duration: 1 s", "duration: 1 s, speed: 3");
  std::string complaints;
  read(text, complaints);
  EXPECT_THAT(complaints, HasSubstr(":7:17: error: mass \"2 m\" is a length; a mass is due"));
  EXPECT_THAT(complaints, HasSubstr("moment has 2 items; 3 are due"));
  EXPECT_THAT(complaints, HasSubstr("simulation settings has no key \"speed\""));
}

TEST(MechanismFile, ComplainsAboutExpressionsWithPlaceKeyAndText) {
  EXPECT_THAT(
      complaints_about("centre_of_mass: [= rod / 2, 0 m, 0 m]",
                       "centre_of_mass: [= rd / 2, 0 m, 0 m]"),
      HasSubstr(":8:38: error: centre_of_mass \"= rd / 2\" uses \"rd\", which is no parameter and "
                "no unit\n    the parameters are crank, rod; did you mean \"rod\"?"));
  EXPECT_THAT(complaints_about("mass: 2 kg", "mass: = rod"),
              HasSubstr("mass \"= rod\" is a length; a mass is due, for example \"860 t\""));
  EXPECT_THAT(complaints_about("  rod: = 3 * crank", "  rod: = 3 * crunk"),
              HasSubstr(":5:8: error: rod \"= 3 * crunk\" uses \"crunk\""));
  EXPECT_THAT(complaints_about("  crank: 1 m", "  sin: 1 m"),
              HasSubstr(":4:3: error: \"sin\" cannot be a parameter"));
}

TEST(MechanismFile, ChecksThatKindsAndKeysFit) {
  EXPECT_THAT(complaints_about("kind: joint, joint: pin", "kind: point, joint: pin"),
              HasSubstr("spring twist acts between points and lacks the key \"from\""));
  EXPECT_THAT(complaints_about("joint: shaft, moment: 4 N m", "joint: shaft, force: 4 N"),
              HasSubstr("force motor gives a force, but joint shaft turns there"));
  EXPECT_THAT(complaints_about("shaft: 30 deg", "shaft: 3 m"),
              HasSubstr("the position of joint shaft takes an angle (it is revolute)"));
  EXPECT_THAT(
      complaints_about("stiffness: 2 N m/rad", "stiffness: 2 N/m"),
      HasSubstr("stiffness of spring twist is a stiffness, but it acts where its joint turns"));
  const std::string torsional = "kind: torsional, from: {body: crank}, to: {body: world}, ";
  EXPECT_THAT(complaints_about("kind: joint, joint: pin, stiffness: 2 N m/rad",
                               torsional + "stiffness: 2 N/m"),
              AllOf(HasSubstr("stiffness of spring twist is a stiffness, but it is a torsional"),
                    HasSubstr("spring twist acts against the turning of two bodies, so it has no "
                              "free_coordinate")));
  EXPECT_THAT(complaints_about("{kind: joint, joint: pin, stiffness: 2 N m/rad, free_coordinate: "
                               "10 deg}",
                               "{kind: torsional, from: {body: crank, position: [1 m, 0 m, 0 m]}, "
                               "to: {body: world}, stiffness: 2 N m/rad}"),
              HasSubstr("so that a position on them means nothing"));
  EXPECT_THAT(complaints_about("x: {joint: guide}", "x: {joint: guide, quantity: tension}"),
              HasSubstr("output x asks for the tension of a joint"));
  EXPECT_THAT(complaints_about("x: {joint: guide}", "x: {joint: guide, rope: tie}"),
              HasSubstr("output x has more than one subject"));
  EXPECT_THAT(complaints_about("x: {joint: guide}", "x: {joint: guide, quantity: force}"),
              HasSubstr("asks for the force of joint guide, which no drive moves"));
  EXPECT_THAT(complaints_about("first: {body: rod, position: [= rod, 0 m, 0 m]}", "first: pin"),
              HasSubstr("loop wrist is revolute: its sides are frames in bodies"));
  EXPECT_THAT(complaints_about("duration: 1 s", "duration: 1 s, start: equilibrium"),
              HasSubstr("begins at rest"));
}

TEST(MechanismFile, ChecksDrives) {
  const auto complaints = [](const std::string& drive) {
    return complaints_about("initial:\n", "drives:\n  d: " + drive + "\ninitial:\n");
  };
  EXPECT_THAT(complaints("{joint: guide}"), HasSubstr("drive d says not how it moves"));
  EXPECT_THAT(complaints("{joint: guide, speed: 3 m/s}"),
              HasSubstr("drive d lacks the key \"jerk\""));
  EXPECT_THAT(
      complaints(
          "{joint: guide, speed: 1 m/s, acceleration: 1 m/s^2, jerk: 1 m/s^3, range: [0 m, 1 m]}"),
      HasSubstr("drive d starts at 3.8 m, outside its range"));
  EXPECT_THAT(complaints("{joint: guide, constant_speed: 3 rad/s}"),
              HasSubstr("constant_speed of drive d is an angular speed, but joint guide slides"));
  EXPECT_THAT(complaints("{joint: shaft, constant_speed: 3 rad/s}"),
              HasSubstr("the initial velocity of joint shaft is that of drive d"));
  EXPECT_THAT(complaints("{joint: pin, table: [[0 s, 0 deg], [0.5 s, 1 deg]]}"),
              HasSubstr("goes from 0 s to 0.5 s, the simulation from 0 s to 1 s"));
}

// A torsion pendulum with three axes alike: a ball on a spherical joint, turned 40 degrees, swings
// with sqrt(k/I) whatever the axis; its spring is free of moment at a yaw of 30 degrees.
TEST(MechanismFile, SimulatesATorsionalSpringAtASphericalJoint) {
  std::string complaints;
  const auto file = read(R"(mechanism: torsion
gravity: 0 m/s^2
bodies:
  ball: {mass: 2 kg, inertia: {xx: 3 kg m^2, yy: 3 kg m^2, zz: 3 kg m^2}}
joints:
  socket: {kind: spherical, child: ball}
springs:
  twist: {kind: torsional, from: {body: world}, to: {body: ball}, stiffness: 12 N m/rad, free_orientation: [0 deg, 0 deg, 30 deg]}
initial: {positions: {socket: [0 deg, 0 deg, 70 deg]}}
simulate: {duration: 1 s, relative_tolerance: 1e-10}
)",
                         complaints);
  ASSERT_TRUE(file) << complaints;
  const dynamics::LiftSystem system = build_mechanism(*file).system;
  const auto result = dynamics::integrate(system, system.q_start(), system.v_start(),
                                          {.relative_tolerance = 1e-10, .sample_interval = 1.0});
  const double degree = std::numbers::pi / 180;
  const double angle = 30 * degree + 40 * degree * std::cos(2.0);
  EXPECT_NEAR(2 * std::atan2(result.q_end[3], result.q_end[0]), angle, 1e-8);
}

TEST(MechanismFile, SimulatesATableDriveAndAConstantSpeed) {
  std::string complaints;
  const auto file = read(R"(mechanism: drives
bodies:
  a: {mass: 1 kg, radii_of_gyration: [1 m, 1 m, 1 m]}
  b: {mass: 1 kg, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  A: {kind: revolute, child: a}
  B: {kind: prismatic, parent: a, child: b}
drives:
  turn: {joint: A, constant_speed: 2 rad/s}
  slide: {joint: B, table: [[0 s, 0 m], [1 s, 1 m], [2 s, 0 m]]}
initial: {positions: {A: 1 rad}}
simulate: {duration: 2 s}
)",
                         complaints);
  ASSERT_TRUE(file) << complaints;
  const dynamics::LiftSystem system = build_mechanism(*file).system;
  const auto result =
      dynamics::integrate(system, system.q_start(), system.v_start(), {.sample_interval = 1.0});
  EXPECT_NEAR(result.q_end[0], 5.0, 1e-12);
  EXPECT_NEAR(result.history.drives[1].position[1], 1.0, 1e-12);
  // A natural spline through these three points is 1.5 t - 0.5 t^3 at first.
  EXPECT_NEAR(result.history.drives[1].velocity[0], 1.5, 1e-12);
}

// In still air until a step of 10 m/s comes: m v' = k (u - v)^2 has v = u - u / (1 + k u t / m), with
// k = 1.25 / 2 kg/m^3 x 1.2 x 2 m2 = 1.5 kg/m. The step takes 1 ms and has the impulse of a third of
// it; what that leaves is of the second order, u (k u 1 ms / m)^2 = 2.5e-6 m/s.
TEST(MechanismFile, AStepOfTheWindDrivesByItsFormula) {
  std::string complaints;
  const auto file = read(R"(mechanism: gust
bodies:
  sail: {mass: 30 kg, radii_of_gyration: [1 m, 1 m, 1 m], wind_areas: [{area: 2 m^2}]}
joints:
  guide: {kind: prismatic, child: sail, axis: [1, 0, 0]}
wind: {speed: 0 m/s, towards: 0 deg, gust: {table: [[20 s, 0 m/s], [20.001 s, 10 m/s]]}}
simulate: {duration: 24 s}
)",
                         complaints);
  ASSERT_TRUE(file) << complaints;
  const BuiltMechanism built = build_mechanism(*file);
  const auto result =
      dynamics::integrate(built.system, built.system.q_start(), built.system.v_start(),
                          {.relative_tolerance = 1e-9, .sample_interval = 1.0});
  EXPECT_NEAR(result.v_end[0], 10 - 10 / (1 + 1.5 * 10 * (4 - 0.002 / 3) / 30), 5e-5);
  EXPECT_TRUE(built.calm);  // at rest there is no gust
}

TEST(MechanismFile, ComplainsAboutGusts) {
  const auto said = [](const std::string& gust) {
    return complaints_about("towards: 0 deg}", "towards: 0 deg, gust: " + gust + "}");
  };
  EXPECT_EQ(said("{magnitude: 6 m/s, start: 0.2 s, duration: 0.5 s}"), "");
  EXPECT_THAT(said("{magnitude: 6 m/s}"),
              HasSubstr("the gust says neither its table nor all of its shape"));
  EXPECT_THAT(said("{magnitude: 6 m/s, table: [[0 s, 0 m/s], [1 s, 6 m/s]]}"),
              HasSubstr("the gust is given twice, by its table and by its magnitude"));
  EXPECT_THAT(said("{shape: operating, table: [[0 s, 0 m/s], [1 s, 6 m/s]]}"),
              HasSubstr("the gust is given twice, by its table and by its shape"));
  EXPECT_THAT(said("{table: [[1 s, 0 m/s], [1 s, 6 m/s]]}"),
              HasSubstr("row 2 of the gust is for 1 s, after 1 s: times must ascend"));
  EXPECT_THAT(said("{table: [[1 s, 0 m/s], [6 m/s, 2 s]]}"),
              HasSubstr("row 2 of the gust is no time with a speed"));
  EXPECT_THAT(said("{table: [[1 s, 0 m/s], [2 s, -6 m/s]]}"),
              HasSubstr("the gust takes 6 m/s from a wind of 4 m/s, which would blow back then"));
  // It falls by 0.268 of its magnitude.
  EXPECT_THAT(
      said("{shape: operating, magnitude: 20 m/s, start: 0 s, duration: 10.5 s}"),
      HasSubstr("the gust takes 5.361 m/s from a wind of 4 m/s, which would blow back then"));
}

TEST(MechanismFile, FreeAndSphericalJointsTakeAnglesOrQuaternions) {
  const auto start_of = [](const std::string& position) {
    std::string complaints;
    const auto file = read(R"(mechanism: free
bodies:
  a: {mass: 1 kg, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  A: {kind: free, child: a}
initial:
  positions: {A: )" + position +
                               R"(}
  velocities: {A: [1 m/s, 2 m/s, 3 m/s, 4 rad/s, 5 rad/s, 6 rad/s]}
simulate: {duration: 1 s}
)",
                           complaints);
    EXPECT_TRUE(file) << complaints;
    return build_mechanism(*file).system;
  };
  const dynamics::LiftSystem by_angles = start_of("[1 m, 2 m, 3 m, 0 deg, 0 deg, 90 deg]");
  const dynamics::LiftSystem by_quaternion = start_of("[1 m, 2 m, 3 m, 2, 0, 0, 2]");
  EXPECT_LT((by_angles.q_start() - by_quaternion.q_start()).norm(), 1e-15);
  Eigen::VectorXd v(6);
  v << 4, 5, 6, 1, 2, 3;  // the kernel's order
  EXPECT_EQ(by_angles.v_start(), v);
}

const std::string robot = R"(<robot name="arm">
  <link name="base"><inertial><mass value="5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0.5 0 0" rpy="0 0 1.5707963267948966"/><mass value="2"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial></link>
  <link name="finger"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/><dynamics damping="0.7" friction="0.1"/></joint>
  <joint name="grip" type="prismatic"><parent link="upper"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="10" velocity="1"/><mimic joint="shoulder" multiplier="0.2" offset="0.1"/></joint>
</robot>
)";

TEST(Urdf, BecomesAMechanism) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", robot);
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto file = read_mechanism("arm.urdf", library, diagnostics);
  ASSERT_TRUE(file) << diagnostics.to_text();
  EXPECT_EQ(file->name, "arm");
  const BodyModel* upper = file->find_body("upper");
  ASSERT_TRUE(upper);
  // The inertia's own frame is turned by a quarter about z: its x axis is the body's y axis.
  EXPECT_NEAR(upper->inertia->value.xx, 2, 1e-12);
  EXPECT_NEAR(upper->inertia->value.yy, 1, 1e-12);
  EXPECT_DOUBLE_EQ(upper->centre_of_mass.x(), 0.5);
  const JointModel* shoulder = file->find_joint("shoulder");
  ASSERT_TRUE(shoulder);
  EXPECT_EQ(shoulder->kind, dynamics::JointKind::revolute);
  EXPECT_DOUBLE_EQ(shoulder->damping.at(0).value.value, 0.7);
  ASSERT_EQ(file->loops.size(), 1U);
  EXPECT_EQ(file->loops[0].ratio->value.dimension, Dimension::length_per_angle);
  std::string notes;
  for (const std::string& note : file->notes) notes += note + "\n";
  EXPECT_THAT(notes, HasSubstr("joints grip, shoulder have limits, which are not enforced"));
  EXPECT_THAT(notes, HasSubstr("joints shoulder have friction, which is not considered"));
  EXPECT_THAT(notes, HasSubstr("link base stands fixed in the world"));
  // The finger follows the shoulder.
  const dynamics::LiftSystem system = build_mechanism(*file).system;
  const dynamics::Mechanism& mechanism = system.mechanism();
  const double turn = system.q_start()[mechanism.body(mechanism.body_index("upper")).q_offset];
  const double slide = system.q_start()[mechanism.body(mechanism.body_index("finger")).q_offset];
  EXPECT_NEAR(slide, 0.2 * turn + 0.1, 1e-9);
}

// Over the whole range of pitch, right angles among them and what lies next to them, to the
// rounding of a quaternion and of three angles.
TEST(Urdf, KeepsRotationsOfEveryPitch) {
  std::vector<Vector3> given;
  std::string text = "<robot name=\"many\"><link name=\"l\"/>\n";
  for (const double from_right_angle : {0.0, 1e-9, 1e-6, 1e-4, 0.0045, 0.02, 0.4, 1.0, 1.5, 1.6}) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 rpy(0.7 * sign - from_right_angle,
                        sign * (std::numbers::pi / 2 - from_right_angle), 2.1 - from_right_angle);
      const std::string name = "j" + std::to_string(given.size());
      text += fmt::format(
          "<link name=\"{0}\"/><joint name=\"{0}\" type=\"fixed\">"
          "<parent link=\"l\"/><child link=\"{0}\"/>"
          "<origin rpy=\"{1:.17g} {2:.17g} {3:.17g}\"/></joint>\n",
          name, rpy.x(), rpy.y(), rpy.z());
      given.push_back(rpy);
    }
  }
  const TemporaryFolder folder;
  folder.write("many.urdf", text + "</robot>\n");
  Diagnostics diagnostics;
  const auto robot_read = import_urdf("many.urdf", {}, diagnostics);
  ASSERT_TRUE(robot_read) << diagnostics.to_text();
  for (std::size_t k = 0; k < given.size(); ++k) {
    const auto& joints = robot_read->parts.joints;
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const JointModel& candidate) {
      return candidate.name.value == "j" + std::to_string(k);
    });
    ASSERT_NE(joint, joints.end());
    EXPECT_LT((rotation_of(joint->attitude) - rotation_of(given[k])).norm(), 4e-15)
        << given[k].transpose();
  }
}

TEST(Urdf, IsTheBaseOfAMechanismFile) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", robot);
  folder.write("mechanism.yaml", R"(mechanism: on-rails
urdf: arm.urdf
bodies:
  cart: {mass: 10 kg, radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  rail: {kind: prismatic, child: cart, axis: [1, 0, 0]}
  bolts: {kind: fixed, parent: cart, child: base}
initial: {positions: {shoulder: 0.2 rad}}
simulate: {duration: 0.1 s}
)");
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto file = read_mechanism("mechanism.yaml", library, diagnostics);
  ASSERT_TRUE(file) << diagnostics.to_text();
  EXPECT_EQ(file->bodies.size(), 4U);
  EXPECT_EQ(file->joints.size(), 4U);
}

TEST(Urdf, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", "<robot name=\"x\"><link/></robot>");
  Diagnostics diagnostics;
  ModelLibrary library({});
  EXPECT_FALSE(read_mechanism("arm.urdf", library, diagnostics));
  EXPECT_THAT(
      diagnostics.to_text(),
      HasSubstr("arm.urdf: error: robot description arm.urdf: a link or joint has no name"));
}

TEST(CraneParameters, ComeFromTheCase) {
  test::SampleLift lift;
  lift.crane = with(lift.crane, "title: Small gantry crane\n",
                    "title: Small gantry crane\nparameters: {height: 10 m, trolley_mass: 8 t}\n");
  lift.crane = with(lift.crane, "position: [0 m, 0 m, 10 m]", "position: [0 m, 0 m, = height]");
  lift.crane = with(lift.crane, "trolley: {mass: 8 t", "trolley: {mass: = trolley_mass");
  lift.lift_case = with(lift.lift_case, "    model: gantry\n",
                        "    model: gantry\n    parameters: {height: 11 m}\n");
  {
    const TemporaryFolder folder;
    lift.write(folder);
    const LiftCase read_case = read_lift_case(".");
    const CraneModel& crane = *read_case.cranes[0].model;
    EXPECT_DOUBLE_EQ(crane.find_joint("traverse")->position.z(), 11);
    EXPECT_DOUBLE_EQ(crane.find_body("trolley")->mass, 8000);
  }
  const auto complaints = [&](const std::string& parameters) {
    test::SampleLift wrong = lift;
    wrong.lift_case = with(wrong.lift_case, "{height: 11 m}", parameters);
    const TemporaryFolder folder;
    wrong.write(folder);
    Diagnostics diagnostics;
    ModelLibrary library({});
    EXPECT_FALSE(read_lift_case("case.yaml", library, diagnostics));
    return diagnostics.to_text();
  };
  EXPECT_THAT(complaints("{hight: 11 m}"),
              HasSubstr("case.yaml:7:18: error: gantry/crane.yaml has no parameter \"hight\"\n"
                        "    its parameters are height, trolley_mass; did you mean \"height\"?"));
  EXPECT_THAT(complaints("{height: 11 t}"),
              HasSubstr("the parameter height is given as a mass, where the model has a length"));
}

TEST(CraneParts, MayHaveSpringsWhoseWorldIsTheCranesBase) {
  test::SampleLift lift;
  lift.crane = with(lift.crane, "drives:\n",
                    "springs:\n  buffer: {kind: point, from: {body: trolley}, to: {body: world, "
                    "position: [1 m, 0 m, 0 m]}, "
                    "stiffness: 1 kN/m, free_length: 1 m}\ndrives:\n");
  lift.lift_case = with(lift.lift_case, "    model: gantry\n",
                        "    model: gantry\n    position: [7 m, 0 m, 0 m]\n");
  const TemporaryFolder folder;
  lift.write(folder);
  const BuiltLift built = build_lift(
      read_lift_case("."), {1e4, Vector3(2, 0, 0.5), Eigen::Vector3d(1e4, 1e4, 1e4).asDiagonal()});
  const auto& springs = std::get<std::vector<dynamics::PointSpring>>(built.system.elements());
  ASSERT_EQ(springs.size(), 1U);
  EXPECT_EQ(springs[0].name(), "C1.buffer");
  EXPECT_EQ(springs[0].definition().to.body, dynamics::world_index);
  EXPECT_EQ(springs[0].definition().to.p_BoQ_B, Vector3(8, 0, 0));
  EXPECT_EQ(built.system.mechanism().body(springs[0].definition().from.body).name, "C1.trolley");
}

/// The complaints about a lift whose crane has these parts more.
std::string complaints_about_crane(const std::string& parts) {
  test::SampleLift lift;
  lift.crane = with(lift.crane, "drives:\n", parts + "drives:\n");
  const TemporaryFolder folder;
  lift.write(folder);
  Diagnostics diagnostics;
  ModelLibrary library({});
  read_lift_case("case.yaml", library, diagnostics);
  return diagnostics.to_text();
}

TEST(CraneParts, LoopsAreChecked) {
  EXPECT_THAT(complaints_about_crane("loops:\n  rod: {kind: distance, first: {body: trolley}, "
                                     "second: {body: wrld}}\n"),
              HasSubstr("loop rod names body \"wrld\", which the crane does not have\n"
                        "    its bodies are gantry, trolley, world; did you mean \"world\"?"));
  EXPECT_THAT(complaints_about_crane("pose: {travers: 1 m}\n"),
              HasSubstr("the pose names joint \"travers\", which the crane does not have\n"
                        "    its joints are travel, traverse; did you mean \"traverse\"?"));
  EXPECT_THAT(complaints_about_crane("pose: {traverse: 10 deg}\n"),
              HasSubstr("the position of joint traverse takes a length (it is prismatic)"));
}

// The rod is as long as in the pose, where the trolley stands at 3 m; the drives cannot leave it.
TEST(CraneParts, DrivesThatOpenALoopAreAnError) {
  EXPECT_THAT(
      complaints_about_crane("loops:\n  rod: {kind: distance, first: {body: trolley}, "
                             "second: {body: gantry}}\npose: {traverse: 3 m}\n"),
      HasSubstr("the loops of crane C1 cannot follow its drives from the pose in which it is put "
                "together to this start; they open with drive travel at 0 m, drive traverse at "
                "3.02 m, where they miss: loop \"rod\" by"));
  EXPECT_THAT(complaints_about_crane(
                  "loops:\n  rod: {kind: distance, first: {body: trolley}, second: {body: gantry}, "
                  "length: 1 m}\npose: {traverse: 3 m}\n"),
              HasSubstr("the key \"pose\" says where joints stand when the crane is put together"));
}

}  // namespace
}  // namespace blocklift::pipeline
