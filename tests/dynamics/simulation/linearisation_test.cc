// Natural modes against closed forms, against an independent eigen-solution by differences, and
// against the free decay of a time integration.
#include "dynamics/simulation/linearisation.h"

#include <cmath>

#include <gmock/gmock.h>

#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using examples::g;
using ::testing::ElementsAre;

LiftSystem at_rest(Mechanism mechanism, std::vector<Rope> ropes, const Eigen::VectorXd& q) {
  OperationBuilder operation;
  const Operation built = operation.build(1.0);
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = {},
                     .operation = built,
                     .q_start = q,
                     .v_start = {}});
}

Linearisation linearised(const LiftSystem& system) {
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  return linearise(system, 0.0, solver.workspace());
}

std::vector<std::string> names(const Linearisation& l) {
  std::vector<std::string> result;
  for (const Mode& mode : l.modes) result.push_back(mode.name);
  return result;
}

BodyDefinition pendulum_link(const std::string& name, const std::string& parent, double mass,
                             double length) {
  return {.name = name,
          .parent = parent,
          .joint = {.kind = JointKind::revolute, .axis = Vector3::UnitY()},
          .X_PJ = Pose::translation({0, 0, parent == std::string(world_name) ? 0.0 : -length}),
          .mass = mass,
          .p_BoBcm_B = {0, 0, -length}};
}

// Compound pendulum: omega^2 = m g l / (I + m l^2), damping ratio d / (2 (I + m l^2) omega).
TEST(Linearisation, CompoundPendulum) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  BodyDefinition bob = pendulum_link("bob", "world", 3.0, 2.0);
  bob.I_BBcm_B = Vector3(1.0, 1.5, 1.2).asDiagonal();
  bob.damping = {4.0};
  builder.add_body(bob);
  const Linearisation l =
      linearised(at_rest(builder.build(), {}, Eigen::VectorXd::Constant(1, 0.3)));
  const double inertia = 1.5 + 3.0 * 4.0;
  const double omega = std::sqrt(3.0 * g * 2.0 / inertia);
  ASSERT_EQ(l.modes.size(), 1u);
  EXPECT_NEAR(l.modes[0].natural_frequency() / omega, 1.0, 1e-9);
  EXPECT_NEAR(l.modes[0].period(), 2 * M_PI / omega, 1e-8);
  EXPECT_NEAR(l.modes[0].damping_ratio(), 4.0 / (2 * inertia * omega), 1e-9);
  EXPECT_EQ(l.modes[0].kind, ModeKind::oscillating);
  EXPECT_EQ(l.modes[0].name, "bob: pendulum along x");
  EXPECT_EQ(l.modes[0].elastic_share, 0.0);
}

// Its kinetic energy is that of its centre's way, m l^2 = 12 kg m^2, and of its turn, I. Where both
// are nearly equal the name has both, whichever is more.
TEST(Linearisation, MotionsThatAreNearlyEqualAreNamedTogether) {
  const auto name = [](double inertia) {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -g});
    BodyDefinition bob = pendulum_link("bob", "world", 3.0, 2.0);
    bob.I_BBcm_B = Vector3(inertia, inertia, 1.0).asDiagonal();
    builder.add_body(bob);
    return linearised(at_rest(builder.build(), {}, Eigen::VectorXd::Constant(1, 0.3)))
        .modes.at(0)
        .name;
  };
  EXPECT_EQ(name(11.0), "bob: pendulum along x");
  EXPECT_EQ(name(11.8), "bob: pendulum along x and pitch about y");
  EXPECT_EQ(name(12.2), "bob: pendulum along x and pitch about y");
  EXPECT_EQ(name(13.0), "bob: pitch about y");
}

// A block on two plumb ropes whose pins are h above its centre of mass, or below it, rights itself
// about the line of the pins by m g h times the tilt, however the ropes give way; about the other
// axis the ropes hold it much better.
TEST(Linearisation, RightingHeightIsThatOfThePins) {
  for (const double height : {1.5, 0.2, -0.4}) {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -g});
    const BodyIndex block = builder.add_body({.name = "block",
                                              .joint = {.kind = JointKind::free},
                                              .mass = 20e3,
                                              .I_BBcm_B = Vector3(4e4, 9e4, 1e5).asDiagonal()});
    const Mechanism mechanism = builder.build();
    constexpr double stiffness = 1e7, length = 10.0;  // N, m
    const double stretched = length * (1 + 20e3 * g / 2 / stiffness);
    std::vector<Rope> ropes;
    for (const double x : {-3.0, 3.0}) {
      RopeDefinition rope;
      rope.name = x < 0 ? "left" : "right";
      rope.points = {{world_index, {x, 0, stretched + height}}, {block, {x, 0, height}}};
      rope.axial_stiffness = stiffness;
      rope.unstretched_length = length;
      ropes.emplace_back(mechanism, rope);
    }
    const LiftSystem system = at_rest(mechanism, ropes, mechanism.zero_configuration());
    EquilibriumSolver solver(system);
    Eigen::VectorXd q = system.q_start();
    solver.solve(0.0, q);
    TangentMatrices tangent(system);
    EXPECT_NEAR(calc_righting_height(system, 0.0, solver.workspace(), block, tangent), height,
                1e-6);
  }
}

// Two equal point masses on equal rods: omega^2 = (2 -+ sqrt 2) g / l (Landau and Lifshitz,
// Mechanics, section 23, problem 2).
TEST(Linearisation, DoublePendulum) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  builder.add_body(pendulum_link("hook", "world", 5.0, 3.0));
  builder.add_body(pendulum_link("load", "hook", 5.0, 3.0));
  const Linearisation l = linearised(at_rest(builder.build(), {}, Eigen::Vector2d(0.2, -0.3)));
  ASSERT_EQ(l.modes.size(), 2u);
  for (const double sign : {-1.0, 1.0}) {
    const double omega = std::sqrt((2.0 + sign * std::sqrt(2.0)) * g / 3.0);
    const Mode& mode = l.modes[sign < 0 ? 0 : 1];
    EXPECT_NEAR(mode.natural_frequency() / omega, 1.0, 1e-9);
    // x_load / x_hook = 1 +- sqrt 2.
    const std::complex<double> ratio =
        mode.bodies[1].displacement_centre.x() / mode.bodies[0].displacement_centre.x();
    EXPECT_NEAR(ratio.real(), 1.0 - sign * std::sqrt(2.0), 1e-7);
    EXPECT_NEAR(ratio.imag(), 0.0, 1e-7);
  }
  EXPECT_THAT(names(l),
              ElementsAre("load: pendulum along x", "hook: pendulum along x against load"));
}

// Bounce on a rope 2 pi sqrt(m/k), its damping ratio as prescribed, and the pendulum of its
// stretched length to both sides, told apart although their periods are the same.
TEST(Linearisation, LoadOnOneRope) {
  examples::SingleRopeLift lift;
  const double omega = std::sqrt(lift.stiffness() / lift.mass);
  lift.damping_time = 2.0 * 0.03 / omega;  // 3 % of critical
  const LiftSystem system = lift.build();
  const Linearisation l = linearised(system);
  ASSERT_EQ(l.modes.size(), 3u);
  EXPECT_THAT(names(l),
              ElementsAre("load: pendulum along x", "load: pendulum along y", "load: bounce"));
  const double length = lift.length + lift.mass * g / lift.stiffness();
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(l.modes[i].natural_frequency(), std::sqrt(g / length), 1e-8);
    EXPECT_NEAR(l.modes[i].damping_ratio(), 0.0, 1e-9);
    EXPECT_NEAR(l.modes[i].elastic_share, 0.0, 1e-9);
  }
  EXPECT_NEAR(l.modes[2].period(), 2 * M_PI * std::sqrt(lift.mass / lift.stiffness()), 1e-9);
  EXPECT_NEAR(l.modes[2].damping_ratio(), 0.03, 1e-9);
  EXPECT_NEAR(l.modes[2].elastic_share, 1.0, 1e-12);
}

struct Bifilar {
  double mass = 4e3, inertia = 20e3, half = 3.0, length = 12.0, stiffness = 2e7;

  LiftSystem build(std::vector<double> places) const {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -g});
    const BodyIndex beam =
        builder.add_body({.name = "beam",
                          .joint = {.kind = JointKind::free},
                          .mass = mass,
                          .p_BoBcm_B = {0, 0, -0.8},
                          .I_BBcm_B = Vector3(0.3 * inertia, inertia, inertia).asDiagonal()});
    Mechanism mechanism = builder.build();
    std::vector<Rope> ropes;
    for (const double x : places) {
      ropes.emplace_back(
          mechanism, RopeDefinition{.name = "rope " + std::to_string(ropes.size()),
                                    .points = {{world_index, {x, 0, length}}, {beam, {x, 0, 0}}},
                                    .axial_stiffness = stiffness,
                                    .unstretched_length = length});
    }
    Eigen::VectorXd q = mechanism.zero_configuration();
    q[0] = 0.1;
    return at_rest(std::move(mechanism), std::move(ropes), q);
  }
};

const Mode& find(const Linearisation& l, const std::string& name) {
  for (const Mode& mode : l.modes) {
    if (mode.name == name) return mode;
  }
  ADD_FAILURE() << "no mode " << name << " among " << ::testing::PrintToString(names(l));
  return l.modes.front();
}

// Bifilar suspension: yaw omega^2 = m g d^2 / (I L), L the stretched length.
TEST(Linearisation, BifilarYaw) {
  const Bifilar bifilar;
  const Linearisation l = linearised(bifilar.build({-bifilar.half, bifilar.half}));
  const double rope_stiffness = bifilar.stiffness / bifilar.length;
  const double length = bifilar.length + 0.5 * bifilar.mass * g / rope_stiffness;
  const double yaw =
      std::sqrt(bifilar.mass * g * bifilar.half * bifilar.half / (bifilar.inertia * length));
  EXPECT_NEAR(find(l, "beam: yaw").natural_frequency() / yaw, 1.0, 1e-8);
  const double bounce = std::sqrt(2.0 * rope_stiffness / bifilar.mass);
  EXPECT_NEAR(find(l, "beam: bounce").natural_frequency() / bounce, 1.0, 1e-8);
}

// On one rope nothing brings the yaw back: it is named, not hidden.
TEST(Linearisation, NeutralYawOnOneRope) {
  const Linearisation l = linearised(Bifilar().build({0.0}));
  ASSERT_EQ(l.modes.size(), 6u);
  EXPECT_EQ(l.modes[0].kind, ModeKind::neutral);
  EXPECT_EQ(l.modes[0].name, "beam: yaw");
  EXPECT_TRUE(std::isinf(l.modes[0].period()));
  EXPECT_EQ(l.modes[1].kind, ModeKind::oscillating);
}

// Nothing brings a trolley back along its level rail: it drifts, and what hangs on it with it.
TEST(Linearisation, NeutralDriftAlongARail) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  BodyDefinition trolley = pendulum_link("trolley", "world", 5.0, 0.0);
  trolley.joint = {.kind = JointKind::prismatic, .axis = Vector3::UnitX()};
  builder.add_body(trolley);
  builder.add_body(pendulum_link("bob", "trolley", 3.0, 2.0));
  const Linearisation l = linearised(at_rest(builder.build(), {}, Eigen::VectorXd::Zero(2)));
  ASSERT_EQ(l.modes.size(), 2u);
  EXPECT_EQ(l.modes[0].kind, ModeKind::neutral);
  EXPECT_EQ(l.modes[0].name, "trolley: drift along x");
  // The free pendulum swings against the trolley: omega^2 = g/l (1 + m/M).
  EXPECT_NEAR(l.modes[1].natural_frequency(), std::sqrt(g / 2.0 * (1 + 3.0 / 5.0)), 1e-9);
}

TEST(Linearisation, UnstableAndOverdamped) {
  // Upside down: growth sqrt(g/l); the solver keeps exact equilibria although they would not last.
  MechanismBuilder builder;
  builder.set_gravity({0, 0, g});
  builder.add_body(pendulum_link("bob", "world", 3.0, 2.0));
  const LiftSystem upright = at_rest(builder.build(), {}, Eigen::VectorXd::Zero(1));
  LiftWorkspace w(upright);
  calc_loads(upright, 0.0, nullptr, w);
  const Linearisation l = linearise(upright, 0.0, w);
  ASSERT_EQ(l.modes.size(), 1u);
  EXPECT_EQ(l.modes[0].kind, ModeKind::unstable);
  EXPECT_NEAR(l.modes[0].eigenvalue.real(), std::sqrt(g / 2.0), 1e-9);
  EXPECT_NEAR(l.modes[0].damping_ratio(), -1.0, 1e-12);

  MechanismBuilder slow;
  slow.set_gravity({0, 0, -g});
  BodyDefinition bob = pendulum_link("bob", "world", 3.0, 2.0);
  bob.damping = {500.0};
  slow.add_body(bob);
  const Linearisation s = linearised(at_rest(slow.build(), {}, Eigen::VectorXd::Zero(1)));
  ASSERT_EQ(s.modes.size(), 2u);
  // m l^2 x^2 + d x + m g l = 0.
  const double half = 500.0 / (2 * 12.0);
  const double root = std::sqrt(half * half - g / 2.0);
  EXPECT_EQ(s.modes[0].kind, ModeKind::overdamped);
  EXPECT_NEAR(s.modes[0].eigenvalue.real(), -half + root, 1e-9);
  EXPECT_NEAR(s.modes[1].eigenvalue.real(), -half - root, 1e-9);
}

// Block on six ropes: an undamped eigen-solution with mass matrix and a stiffness by central
// differences of the forces, which share nothing with the derivatives.
TEST(Linearisation, BlockOnSixRopesAgainstDifferences) {
  const LiftSystem lift = examples::block_on_six_ropes();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  LiftWorkspace& w = solver.workspace();
  const Linearisation l = linearise(lift, 0.0, w);
  const Mechanism& mechanism = lift.mechanism();
  InverseDynamicsWorkspace inverse(mechanism);
  const auto residual = [&](const Eigen::VectorXd& e) {
    LiftWorkspace moved(lift);
    set_drives(lift, 0.0, false, moved);
    mechanism.integrate(q, e, 1.0, moved.q);
    moved.v.setZero();
    calc_loads(lift, 0.0, nullptr, moved);
    Eigen::VectorXd tau(6);
    compute_inverse_dynamics(mechanism, moved.kinematics, moved.v, Eigen::VectorXd::Zero(6),
                             moved.loads.F_Bo_W, inverse, tau);
    return tau;
  };
  Eigen::MatrixXd K(6, 6), M(6, 6);
  constexpr double h = 1e-4;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(6, k);
    K.col(k) =
        (8.0 * (residual(h * e) - residual(-h * e)) - residual(2 * h * e) + residual(-2 * h * e)) /
        (12 * h);
  }
  MassMatrixWorkspace workspace(mechanism);
  compute_mass_matrix(mechanism, w.kinematics, workspace, M);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> reference(
      0.5 * (K + K.transpose()), M);
  ASSERT_EQ(l.modes.size(), 6u);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Mode& mode = l.modes[i];
    EXPECT_NEAR(mode.natural_frequency() / std::sqrt(reference.eigenvalues()[i]), 1.0, 1e-6)
        << mode.name;
  }
  // 1 % of critical in heave, as the ropes were chosen.
  EXPECT_NEAR(find(l, "block: bounce").damping_ratio(), 0.01, 1e-4);
}

// What the time integration does by itself: period and decay of the bounce of a load let go.
TEST(Linearisation, FreeDecayOfATimeIntegration) {
  examples::SingleRopeLift lift;
  const double omega = std::sqrt(lift.stiffness() / lift.mass);
  lift.damping_time = 2.0 * 0.02 / omega;
  lift.duration = 6.0;
  const LiftSystem system = lift.build();
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const Mode mode = linearise(system, 0.0, solver.workspace()).modes.back();
  const double rest = q[2];
  q[2] += 1e-3;
  const IntegrationResult result =
      integrate(system, q, system.v_start(), {.relative_tolerance = 1e-9, .sample_interval = 1e-3});
  // Peaks of the height above rest by a parabola through three samples.
  std::vector<double> times, heights;
  const auto z = result.history.bodies[0].pose.col(2).array() - rest;
  for (Eigen::Index i = 1; i + 1 < z.size(); ++i) {
    if (!(z[i] > z[i - 1] && z[i] >= z[i + 1])) continue;
    const double curvature = z[i - 1] - 2 * z[i] + z[i + 1];
    const double offset = 0.5 * (z[i - 1] - z[i + 1]) / curvature;
    times.push_back(result.history.time[i] + 1e-3 * offset);
    heights.push_back(z[i] - 0.125 * (z[i - 1] - z[i + 1]) * (z[i - 1] - z[i + 1]) / curvature);
  }
  ASSERT_GT(times.size(), 10u);
  const double periods = static_cast<double>(times.size() - 1);
  const double damped_period = (times.back() - times.front()) / periods;
  EXPECT_NEAR(damped_period / (2 * M_PI / mode.eigenvalue.imag()), 1.0, 1e-5);
  const double decrement = std::log(heights.front() / heights.back()) / periods;
  const double ratio = decrement / std::sqrt(4 * M_PI * M_PI + decrement * decrement);
  EXPECT_NEAR(ratio / mode.damping_ratio(), 1.0, 1e-3);
  EXPECT_NEAR(mode.damping_ratio(), 0.02, 1e-9);
}

// A platform on two parallel rods that are loops swings without turning: omega^2 = g / l, and the
// rods' tension is all that brings it back. As a tree it has three degrees of freedom, with the
// rods one.
TEST(Linearisation, PlatformOnTwoRods) {
  constexpr double rod = 4.0;
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  builder.add_body({.name = "platform",
                    .joint = {.kind = JointKind::planar,
                              .axis = Vector3::UnitY(),
                              .second_axis = Vector3::UnitX()},
                    .mass = 700,
                    .p_BoBcm_B = {0.2, 0, -0.3},
                    .I_BBcm_B = Vector3(80, 90, 100).asDiagonal()});
  for (const double x : {-1.5, 1.5}) {
    LoopDefinition loop;
    loop.name = x < 0 ? "left rod" : "right rod";
    loop.kind = LoopKind::distance;
    loop.first = std::string(world_name);
    loop.second = "platform";
    loop.X_FirstK = Pose::translation({x, 0, rod});
    loop.X_SecondK = Pose::translation({x, 0, 0});
    loop.length = rod;
    builder.add_loop(loop);
  }
  const LiftSystem system = at_rest(builder.build(), {}, Eigen::Vector3d::Zero());
  LiftWorkspace w(system);
  w.v.setZero();
  calc_loads(system, 0.0, nullptr, w);
  const Linearisation l = linearise(system, 0.0, w);
  ASSERT_EQ(l.modes.size(), 1u);
  EXPECT_NEAR(l.modes[0].natural_frequency() / std::sqrt(g / rod), 1.0, 1e-9);
  EXPECT_EQ(l.modes[0].name, "platform: pendulum along x");
  EXPECT_LT(l.modes[0].bodies[0].rotation.norm(), 1e-9);
}

// Along an operation: the pendulum of the turn-over shortens as the block goes up.
TEST(Linearisation, FollowsAnOperation) {
  const LiftSystem lift = test::two_goliaths();
  const std::vector<Linearisation> sweep = linearise_sweep(lift, {0.0, 260.0}, lift.q_start(), 5.0);
  ASSERT_EQ(sweep.size(), 2u);
  for (const Linearisation& l : sweep) {
    EXPECT_EQ(l.modes.size(), 24u);
    for (const Mode& mode : l.modes) EXPECT_EQ(mode.kind, ModeKind::oscillating) << mode.name;
  }
  EXPECT_LT(sweep[1].modes[0].period(), sweep[0].modes[0].period());
  // The slow ones, of which a lift engineer thinks first: level swings and yaw of the block.
  EXPECT_EQ(sweep[0].modes[0].name, "block: pendulum along x");
  EXPECT_EQ(sweep[0].modes[1].name, "block: pendulum along y");
  EXPECT_EQ(sweep[0].modes[2].name, "block: yaw");
}

}  // namespace
}  // namespace blocklift::dynamics
