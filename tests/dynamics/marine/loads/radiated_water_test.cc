// Bodies afloat in water that they set in motion, as part of a lift.
#include "dynamics/marine/loads/radiated_water.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/diffraction_force.h"
#include "dynamics/marine/radiation/floating_motion.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/newton_matrix.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double water_density = 1000, gravity = 10;

/// Two boxes of 8 x 4 x 2 m, half in the water, 10 m apart, tied by the water: made up, with the
/// structure of a real database. A_inf is `ratio` times the bodies' mass.
std::shared_ptr<HydrodynamicDatabase> made_up(double ratio) {
  auto database = std::make_shared<HydrodynamicDatabase>();
  database->water = {.density = water_density, .gravity = gravity};
  database->body_names = {"A", "B"};
  database->reference_points = {{0, -5, 0}, {0, 5, 0}};
  Random random(7);
  const double mass = water_density * 8 * 4 * 1;
  Eigen::VectorXd scale(12);
  scale << 1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2;
  const auto positive = [&] {
    Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(12, 12, [&] { return random.uniform(-1, 1); });
    Eigen::MatrixXd P = 0.05 * B * B.transpose() + Eigen::MatrixXd::Identity(12, 12);
    return Eigen::MatrixXd(scale.asDiagonal() * P * scale.asDiagonal());
  };
  database->infinite_added_mass = ratio * mass * positive();
  const Eigen::MatrixXd P = 2 * mass * positive(), Q = mass * positive();
  database->time_step = 0.2;
  for (int n = 0; n < 50; ++n) {
    const double t = 0.2 * n;
    database->retardation.push_back(std::exp(-t) * P + std::exp(-0.8 * t) * std::cos(2 * t) * Q);
  }
  return database;
}

std::vector<BodyFrame> frames() { return {{1, Pose::identity()}, {2, Pose::identity()}}; }

/// The boxes with hulls in calm water; Bo amidships in the water line.
LiftSystem two_boxes(std::shared_ptr<const RadiatedWater> water, const Eigen::VectorXd& heave,
                     double duration = 10.0) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -gravity});
  for (const char* name : {"A", "B"}) {
    builder.add_body({.name = name,
                      .joint = {.kind = JointKind::free},
                      .mass = water_density * 8 * 4 * 1,
                      .I_BBcm_B = Vector3(60e3, 200e3, 240e3).asDiagonal()});
  }
  const Mechanism mechanism = builder.build();
  const auto sea = std::make_shared<const Sea>(
      Sea{WaveField(Water{.density = water_density, .gravity = gravity}), {}});
  const auto hull = std::make_shared<const HullClusters>(make_box({8, 4, 2}, {4, 2, 2, 1}));
  ForceElements elements;
  for (const int body : {1, 2}) {
    std::get<std::vector<HullForce>>(elements).push_back(HullForce({"hull", body, hull, sea}));
  }
  Eigen::VectorXd q = mechanism.zero_configuration();
  q[1] = -5;
  q[8] = 5;
  q[2] = heave[0];
  q[9] = heave[1];
  return LiftSystem({.mechanism = mechanism,
                     .ropes = {},
                     .supports = {},
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(duration),
                     .q_start = q,
                     .v_start = {},
                     .water = std::move(water)});
}

/// The same, linear: all modes free, for small motions.
LinearFloatation linear_boxes(const Eigen::VectorXd& heave) {
  const double mass = water_density * 8 * 4 * 1;
  Eigen::VectorXd M(12), C(12);
  const double GM_T = -0.5 + 4.0 * 4 / 12, GM_L = -0.5 + 8.0 * 8 / 12;
  for (const int i : {0, 6}) {
    M.segment<6>(i) << mass, mass, mass, 60e3, 200e3, 240e3;
    C.segment<6>(i) << 0, 0, water_density * gravity * 32, mass * gravity * GM_T,
        mass * gravity * GM_L, 0;
  }
  LinearFloatation boxes{M.asDiagonal(), C.asDiagonal(), Eigen::VectorXd::Zero(12)};
  boxes.start[2] = heave[0];
  boxes.start[8] = heave[1];
  return boxes;
}

// The lift against Cummins' equation of small motions, marched by itself, with an added mass of a
// half and of 50 times the mass: implicit, it is stable at any ratio.
TEST(RadiatedWater, MovesBodiesAsCumminsEquationDoes) {
  const Eigen::Vector2d heave(0.01, -0.004);
  for (const double ratio : {0.5, 50.0}) {
    const auto database = made_up(ratio);
    const auto water = std::make_shared<const RadiatedWater>(
        RadiatedWater::Definition{frames(), database, {1e-3, 100}});
    const LiftSystem system = two_boxes(water, heave);
    const IntegrationResult result =
        integrate(system, system.q_start(), system.v_start(),
                  {.relative_tolerance = 1e-9, .sample_interval = 0.1});
    const FloatingMotion reference =
        march_with_state_space(linear_boxes(heave), database->infinite_added_mass,
                               MemoryStateSpace(*database, 1e-3, 100), 0.01, 10.0);
    double difference = 0, largest = 0;
    for (Eigen::Index i = 0; i < 100; ++i) {
      const auto n = static_cast<std::size_t>(10 * i);
      for (const int body : {0, 1}) {
        const double z = result.history.bodies[body].pose(i, 2);
        const double z_linear = reference.position[n][6 * body + 2];
        difference = std::max(difference, std::abs(z - z_linear));
        if (i > 20) largest = std::max(largest, std::abs(z));
      }
    }
    EXPECT_LT(difference, 2e-3 * 0.01) << "ratio " << ratio;  // second order in the motion
    EXPECT_GT(largest, 1e-4);
    // Energy: what the memory takes is accounted for.
    const EnergyHistory& e = result.history.energy;
    const Eigen::VectorXd total = e.kinetic + e.gravity + e.elastic - e.outside_work + e.dissipated;
    const double turned_over = e.kinetic.maxCoeff();
    EXPECT_LT((total.array() - total[0]).abs().maxCoeff(), 1e-4 * turned_over);
  }
}

/// The memory with states besides that nothing drives and that act on nothing.
MemoryStateSpace with_idle_states(const MemoryStateSpace& memory, Eigen::Index idle) {
  const Eigen::Index states = memory.state_count(), modes = memory.mode_count();
  Eigen::VectorXd decay = Eigen::VectorXd::Constant(states + idle, -1.0);
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(states + idle);
  decay.head(states) = memory.decay();
  turn.head(states) = memory.turn();
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(states + idle, modes);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(modes, states + idle);
  B.topRows(states) = memory.B();
  C.leftCols(states) = memory.C();
  return MemoryStateSpace(decay, turn, std::move(B), std::move(C), memory.error());
}

// The integration's norm is a mean over the unknowns. States that have nothing to tell must not let
// bodies err more: by a mean over all, 4,000 beside 26 of the bodies and some 40 of the water would
// allow about eight times the error. Twice is measured, since they thin out the water's own states.
TEST(RadiatedWater, IdleStatesDoNotLoosenTheToleranceOfBodies) {
  const auto database = made_up(1);
  const MemoryStateSpace memory(*database, 1e-3, 100);
  const auto end_of = [&](Eigen::Index idle, double tolerance) {
    HydrodynamicSeries series;
    series.draughts = {1.0};
    series.databases = {*database};
    series.memories.push_back(with_idle_states(memory, idle));
    RadiatedWater::Definition definition;
    definition.frames = frames();
    definition.series = std::make_shared<const HydrodynamicSeries>(series);
    const auto water = std::make_shared<const RadiatedWater>(definition);
    const LiftSystem system = two_boxes(water, Eigen::Vector2d(0.1, -0.04));
    EXPECT_EQ(system.memory_count(), memory.state_count() + idle);
    return integrate(system, system.q_start(), system.v_start(),
                     {.relative_tolerance = tolerance, .sample_interval = 0.5})
        .q_end;
  };
  const Eigen::VectorXd exact = end_of(0, 1e-11);
  for (const double tolerance : {1e-5, 1e-6, 1e-7}) {
    const double error = (end_of(0, tolerance) - exact).norm();
    EXPECT_LT((end_of(4000, tolerance) - exact).norm(), 3 * error) << tolerance;
  }
}

// About the rest, where the terms that the Jacobian leaves out vanish, it is exact; and the
// structured solution of Newton's equations is that of the whole matrix.
TEST(RadiatedWater, JacobianAndNewtonMatrix) {
  const auto water = std::make_shared<const RadiatedWater>(
      RadiatedWater::Definition{frames(), made_up(3), {1e-3, 100}});
  const LiftSystem system = two_boxes(water, Eigen::Vector2d::Zero());
  ASSERT_GT(system.memory_count(), 2);
  LiftWorkspace w(system);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(system.state_size());
  get_state(system, system.q_start(), system.v_start(), y);
  const Contacts contacts;
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd J(y.size(), y.size());
  calc_jacobian(system, 0, y, &contacts, w, workspace, J);
  const Eigen::MatrixXd difference = difference_jacobian(system, 0, y, &contacts, w, 1e-6);
  EXPECT_LT((J - difference).lpNorm<Eigen::Infinity>(), 1e-6 * J.lpNorm<Eigen::Infinity>());

  constexpr double gamma = 0.07;
  NewtonMatrix newton(system);
  Eigen::VectorXd ydot(y.size());
  calc_right_hand_side(system, 0, y, &contacts, w, ydot);
  newton.set_point(system, 0, w);
  ASSERT_TRUE(newton.factorise(system, gamma));
  Random random(2);
  const Eigen::VectorXd b = random.values(static_cast<int>(y.size()), 1);
  Eigen::VectorXd x(y.size());
  newton.solve(system, b, x);
  const Eigen::VectorXd dense =
      (Eigen::MatrixXd::Identity(y.size(), y.size()) - gamma * J).partialPivLu().solve(b);
  EXPECT_LT((x - dense).norm(), 1e-9 * dense.norm());
}

// At rest the water does nothing; heave swings with its infinite-frequency added mass.
TEST(RadiatedWater, EquilibriumAndPeriods) {
  auto database = made_up(1);
  const double mass = water_density * 8 * 4 * 1;
  database->infinite_added_mass = mass * Eigen::MatrixXd::Identity(12, 12);
  const auto water = std::make_shared<const RadiatedWater>(
      RadiatedWater::Definition{frames(), database, {1e-3, 100}});
  const LiftSystem system = two_boxes(water, Eigen::Vector2d(0.1, 0.2));
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0, q);
  EXPECT_NEAR(q[2], 0, 1e-8);
  EXPECT_NEAR(q[9], 0, 1e-8);
  const Linearisation modes = linearise(system, 0, solver.workspace());
  const double heave = std::sqrt(water_density * gravity * 32 / (2 * mass));
  int found = 0;
  for (const Mode& mode : modes.modes) {
    if (std::abs(mode.natural_frequency() - heave) < 1e-6 * heave) ++found;
  }
  EXPECT_EQ(found, 2);
}

TEST(RadiatedWater, AllocatesNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not counted in this build";
  const auto water = std::make_shared<const RadiatedWater>(
      RadiatedWater::Definition{frames(), made_up(3), {1e-3, 100}});
  const LiftSystem system = two_boxes(water, Eigen::Vector2d(0.1, 0.2));
  LiftWorkspace w(system);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(system.state_size(), 0.1), ydot(y.size());
  get_state(system, system.q_start(), system.v_start(), y);
  const Contacts contacts;
  const long before = blocklift::test::allocations();
  calc_right_hand_side(system, 0, y, &contacts, w, ydot);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

TEST(RadiatedWater, NeedsAPartForEachBody) {
  EXPECT_THAT(
      [] {
        RadiatedWater({{{1, Pose::identity()}}, made_up(1)});
      },
      ThrowsMessage<ModelError>(HasSubstr("holds 2 bodies, and 1 float")));
}

/// Diffraction that turns with the heading as a dipole does: X = w cos(theta - m pi/6).
std::shared_ptr<HydrodynamicDatabase> scattering() {
  auto database = made_up(1);
  database->frequencies = {0.5, 0.8, 1.1};
  for (int j = 0; j < 72; ++j) database->headings.push_back(j * std::numbers::pi / 36);
  for (const double w : database->frequencies) {
    Eigen::MatrixXcd X(12, 72);
    for (Eigen::Index m = 0; m < 12; ++m) {
      for (Eigen::Index j = 0; j < 72; ++j) {
        const double theta = database->headings[j];
        const Vector3& p = database->reference_points[m / 6];
        const double phase = w * w / gravity * (std::cos(theta) * p.x() + std::sin(theta) * p.y());
        X(m, j) = w * std::cos(theta - static_cast<double>(m % 6) * std::numbers::pi / 6) *
                  std::polar(1.0, -phase);
      }
    }
    database->diffraction.push_back(X);
    database->froude_krylov.push_back(2.0 * X);
  }
  return database;
}

DiffractionForce::Definition diffraction(const std::vector<WaveComponent>& waves) {
  DiffractionForce::Definition d;
  d.name = "diffraction";
  d.frame = {1, Pose::identity()};
  d.database = scattering();
  d.database_body = 1;
  d.sea = std::make_shared<const Sea>(
      Sea{WaveField(Water{.density = water_density, .gravity = gravity}, waves), {}});
  return d;
}

// Where the database has the body, at its frequencies and between; displaced and turned, the wave
// is met elsewhere and from another side.
TEST(DiffractionForce, FollowsTheBody) {
  constexpr double w = 0.8, theta = 0.6, amplitude = 1.5, wave_phase = 0.4;
  const DiffractionForce force(diffraction({{amplitude, w, theta, wave_phase}}));
  test::OneBody body;
  for (const double yaw : {0.0, 0.5, -2.5}) {
    const Vector3 place(3, 8, 0);
    body.q.head<3>() = place;
    body.q.tail<4>() = quaternion_from_rotation(rotation_about(Vector3::UnitZ(), yaw));
    body.v << 0.1, -0.2, 0.3, 1, 2, -1;
    body.time = 3.7;
    body.update();
    const double phase =
        w * body.time - wave_phase -
        w * w / gravity * (std::cos(theta) * place.x() + std::sin(theta) * place.y());
    Eigen::Matrix<double, 6, 1> expected;
    for (int m = 0; m < 6; ++m) {
      expected[m] =
          amplitude * w * std::cos(theta - yaw - m * std::numbers::pi / 6) * std::cos(phase);
    }
    const Matrix3 R = rotation_about(Vector3::UnitZ(), yaw);
    const ForceVector F = force.calc_force(body.state());
    // Linear between headings 5 degrees apart: (h/2)^2/2 of the amplitude at most.
    EXPECT_LT((F.force - R * expected.head<3>()).norm(), 2e-3 * amplitude);
    EXPECT_LT((F.moment - R * expected.tail<3>()).norm(), 2e-3 * amplitude);
    test::expect_balanced(body, force);
  }
}

TEST(DiffractionForce, WithFroudeKrylovAndBetweenFrequencies) {
  auto definition = diffraction({{1.0, 0.65, 0.0, 0.0}});
  const DiffractionForce scattered(definition);
  definition.froude_krylov = FroudeKrylovPart::whole;
  const DiffractionForce whole(definition);
  definition.froude_krylov = FroudeKrylovPart::along_water;
  const DiffractionForce along_water(definition);
  test::OneBody body;
  body.time = 0.3;
  const double alone = scattered.calc_force(body.state()).force.x();
  EXPECT_NEAR(alone, 0.65 * std::cos(0.65 * 0.3), 1e-9);
  EXPECT_NEAR(whole.calc_force(body.state()).force.x(), 3 * alone, 1e-9);
  // The incident wave's force is twice the scattered one in every mode.
  const ForceVector part = scattered.calc_force(body.state());
  const ForceVector mixed = along_water.calc_force(body.state());
  EXPECT_LT((mixed.force - part.force.cwiseProduct(Vector3(3, 3, 1))).norm(), 1e-9);
  EXPECT_LT((mixed.moment - part.moment.cwiseProduct(Vector3(1, 1, 3))).norm(), 1e-9);
}

TEST(DiffractionForce, RefusesWavesThatTheDatabaseDoesNotHold) {
  EXPECT_THAT(
      [] {
        DiffractionForce(diffraction({{1, 2.0, 0, 0}}));
      },
      ThrowsMessage<ModelError>(HasSubstr("0.5 to 1.1 rad/s")));
  auto definition = diffraction({{1, 0.8, 0, 0}});
  // 0 and 360 degrees may both be there.
  auto closed = std::make_shared<HydrodynamicDatabase>(*definition.database);
  closed->headings.push_back(closed->headings.front() + 2 * std::numbers::pi);
  for (auto* forces : {&closed->froude_krylov, &closed->diffraction}) {
    for (Eigen::MatrixXcd& force : *forces) {
      force.conservativeResize(Eigen::NoChange, force.cols() + 1);
      force.rightCols(1) = force.leftCols(1);
    }
  }
  definition.database = closed;
  EXPECT_NO_THROW(DiffractionForce{definition});
  auto few = std::make_shared<HydrodynamicDatabase>(*definition.database);
  few->headings.resize(20);
  definition.database = few;
  EXPECT_THAT([&] { DiffractionForce{definition}; },
              ThrowsMessage<ModelError>(HasSubstr("at most 45 degrees apart")));
}

}  // namespace
}  // namespace blocklift::dynamics
