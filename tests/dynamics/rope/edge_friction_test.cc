// Friction between ropes and edges: the capstan in closed form, a band brake, curvature of the
// helix, the energy account of loads that swing over edges.
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/rope/rope_split.h"
#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/rope/balance.h"
#include "tests/dynamics/rope/split_jacobian.h"

namespace blocklift::dynamics {
namespace {

using std::numbers::pi;
using test::imbalance_of;
using test::standard_gravity;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A rope from a winch, level, over an edge of the world along y, down to a weight: a quarter turn.
struct QuarterTurn {
  double radius = 0.3, friction = 0.2;
  double payout = 0.3;     // m
  double begins_at = 0.2;  // s
  static constexpr double mass = 10e3, EA = 40e6, length = 15.0;

  LiftSystem build() const {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -standard_gravity});
    builder.add_body({.name = "weight", .joint = {.kind = JointKind::translational}, .mass = mass});
    Mechanism mechanism = builder.build();
    const RopeDefinition rope{.name = "rope",
                              .points = {{world_index, {-10, 0, radius}}, {1, Vector3::Zero()}},
                              .axial_stiffness = EA,
                              .damping_time = 0.05,
                              .unstretched_length = length,
                              .edges = {{.name = "edge",
                                         .begin_B = {0, -1, 0},
                                         .end_B = {0, 1, 0},
                                         .outside_B = {1, 0, 1},
                                         .radius = radius,
                                         .friction = friction}}};
    OperationBuilder operation;
    operation.add_winch("winch", 0, length);
    operation.add_move("winch", {begins_at, payout, {0.2, 1.0, 5.0}});
    const Operation built = operation.build(3.0);
    std::vector<Rope> ropes;
    ropes.emplace_back(mechanism, rope);
    return LiftSystem({.mechanism = std::move(mechanism),
                       .ropes = std::move(ropes),
                       .operation = built,
                       .q_start = start()});
  }
  // Hanging still, as without friction.
  Eigen::Vector3d start() const {
    const double stretched = length * (1.0 + mass * standard_gravity / EA);
    return {radius, 0, -(stretched - 10.0 - 0.5 * pi * radius)};
  }
};

// Euler (1769), Eytelwein (1808): where the rope slips over a quarter turn, the tensions are as
// exp(mu pi / 2), whichever way it goes; a sharp edge is a round one without radius.
TEST(EdgeFriction, IsThatOfACapstan) {
  for (const double radius : {0.0, 0.3}) {
    for (const double payout : {-0.3, 0.3}) {
      QuarterTurn model{.radius = radius, .payout = payout};
      const LiftSystem lift = model.build();
      const IntegrationResult run =
          integrate(lift, lift.q_start(), lift.v_start(),
                    {.relative_tolerance = 1e-9, .sample_interval = 0.01});
      const RopeHistory& rope = run.history.ropes[0];
      const EdgeHistory& edge = rope.edges[0];
      const double capstan = std::exp(0.2 * pi / 2.0);
      EXPECT_NEAR(edge.first_tension[0], edge.last_tension[0], 1e-6);
      // While the winch runs at 0.2 m/s.
      for (Eigen::Index i = 100; i < 150; ++i) {
        const double ratio = edge.first_tension[i] / edge.last_tension[i];
        EXPECT_NEAR(payout < 0.0 ? ratio : 1.0 / ratio, capstan, 1e-9) << i;
        EXPECT_DOUBLE_EQ(rope.tension[i], std::max(edge.first_tension[i], edge.last_tension[i]));
        EXPECT_NEAR(rope.first_force.row(i).norm(), edge.first_tension[i], 1e-9 * rope.tension[i]);
        EXPECT_NEAR(rope.last_force.row(i).norm(), edge.last_tension[i], 1e-9 * rope.tension[i]);
        const Vector3 force = edge.force.row(i);
        EXPECT_NEAR(force.x(), -edge.first_tension[i], 1e-6 * rope.tension[i]);
        EXPECT_NEAR(force.z(), -edge.last_tension[i], 1e-6 * rope.tension[i]);
      }
      EXPECT_GE(run.statistics.bend_changes, 1);
      // From where it slips: before, the winch pulls at what stands still, nothing that moves feels
      // it, and its work is summed by the steps of a motion at rest.
      EXPECT_LT(imbalance_of(run.history.energy, 60), 2e-6 * QuarterTurn::mass * standard_gravity);
      // Friction takes the difference of the tensions times the way.
      const Eigen::Index last = run.history.sample_count() - 1;
      const double mg = QuarterTurn::mass * standard_gravity;
      const double difference = payout < 0.0 ? capstan - 1.0 : 1.0 - 1.0 / capstan;
      EXPECT_NEAR(run.history.energy.dissipated[last], 0.3 * mg * difference,
                  0.1 * 0.3 * mg * difference);
    }
  }
}

// A drum of the radius R that is driven, under a rope that comes from one side of it and goes to
// the other; the rope pulls by 20 kN.
struct BandBrake {
  static constexpr double R = 0.4, EA = 10e6, friction = 0.5, travel = 0.6;
  // The tangents from 5 m aside and 3 m below the axis, and the arc between them.
  static constexpr double reach = 5.0, depth = 3.0;
  const double distance = std::hypot(reach, depth);
  const double wrap = 2.0 * (std::atan2(reach, -depth) - std::acos(R / distance));
  const double length = 2.0 * std::sqrt(distance * distance - R * R) + R * wrap;
  const double unstretched = length / (1.0 + 20e3 / EA);

  Mechanism mechanism = [] {
    MechanismBuilder builder;
    builder.add_body({.name = "drum",
                      .joint = {.kind = JointKind::revolute, .axis = Vector3::UnitY()},
                      .mass = 1e3,
                      .I_BBcm_B = Vector3(100, 100, 100).asDiagonal(),
                      .driven = {true}});
    return builder.build();
  }();
  RopeDefinition rope() const {
    return {.name = "band",
            .points = {{world_index, {-reach, 0, -depth}}, {world_index, {reach, 0, -depth}}},
            .axial_stiffness = EA,
            .unstretched_length = unstretched,
            .edges = {{.name = "drum",
                       .body = 1,
                       .begin_B = {0, -1, 0},
                       .end_B = {0, 1, 0},
                       .outside_B = {0, 0, 1},
                       .radius = R,
                       .friction = friction}}};
  }
};

// As long as it sticks the band goes with the drum's surface, although the path does not change:
// one side gets R alpha longer, the other shorter.
TEST(EdgeFriction, RopeRollsWithADrum) {
  const BandBrake brake;
  const std::vector<Rope> ropes{Rope(brake.mechanism, brake.rope())};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(brake.mechanism);
  RopeSplit split(ropes[0]);
  ASSERT_TRUE(split.rubs() && split.rubs_at_edges());
  const auto turn = [&](double angle) {
    Eigen::VectorXd q(1), v(1);
    q << angle;
    v << 0.7;
    compute_kinematics(brake.mechanism, q, v, kinematics);
    ropes[0].calc_path(kinematics, path);
    RopeLoad load = ropes[0].calc_load(path, {brake.unstretched, 0.0});
    if (!split.acts()) split.begin(ropes[0], kinematics, path, load);
    split.divide(ropes[0], kinematics, path, load);
    return load;
  };
  turn(0.0);
  EXPECT_NEAR(split.tension(0), 20e3, 1e-6);
  EXPECT_NEAR(split.wrap(0), brake.wrap, 1e-14);
  const double half = split.unstretched_length(0);
  // From +z towards +x, towards the last point.
  constexpr double alpha = 0.002;
  const double more = BandBrake::EA / half * BandBrake::R * alpha;
  const RopeLoad load = turn(alpha);
  EXPECT_NEAR(path.length, brake.length, 1e-12);
  EXPECT_NEAR(split.tension(0), 20e3 + more, 1e-5);
  EXPECT_NEAR(split.tension(1), 20e3 - more, 1e-5);
  EXPECT_DOUBLE_EQ(load.tension, split.tension(0));
  // Carried on in between it is the same.
  split.carry(ropes[0], kinematics, path);
  turn(alpha);
  EXPECT_NEAR(split.tension(0), 20e3 + more, 1e-5);
  turn(2.0 * alpha);
  EXPECT_NEAR(split.tension(0), 20e3 + 2.0 * more, 1e-5);
  EXPECT_GT(split.indicator(0), 0.0);
  // Where it slips, the drum runs on beneath the band: R omega against its surface.
  split.set_motion(0, BendMotion::to_first);
  turn(2.0 * alpha);
  EXPECT_NEAR(split.tension(0) / split.tension(1), std::exp(0.5 * brake.wrap), 1e-12);
  EXPECT_NEAR(split.slip_rate(0), -BandBrake::R * 0.7, 3e-3 * BandBrake::R * 0.7);
}

// A band brake: the drive's moment is (T_1 - T_2) R, and its work is lost.
TEST(EdgeFriction, BrakesADrum) {
  const BandBrake brake;
  OperationBuilder operation;
  Mechanism mechanism = brake.mechanism;
  operation.add_joint_drive(mechanism, "drum", 1, 0.0);
  operation.add_move("drum", {0.0, BandBrake::travel, {0.5, 5.0, 50.0}});
  const Operation built = operation.build(1.5);
  std::vector<Rope> ropes;
  ropes.emplace_back(mechanism, brake.rope());
  const LiftSystem lift({.mechanism = std::move(mechanism),
                         .ropes = std::move(ropes),
                         .operation = built,
                         .q_start = Eigen::VectorXd::Zero(1)});
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.01});
  const EdgeHistory& edge = run.history.ropes[0].edges[0];
  constexpr Eigen::Index middle = 60;
  const double first = edge.first_tension[middle], last = edge.last_tension[middle];
  EXPECT_NEAR(first / last, std::exp(0.5 * brake.wrap), 1e-9);
  EXPECT_NEAR(run.history.drives[0].force[middle], (first - last) * BandBrake::R, 1e-3);
  EXPECT_GE(run.statistics.bend_changes, 1);
}

// A block on a sling round its two lower edges, obliquely, from a hook to another.
struct ObliqueCradle {
  double radius = 0.0, friction = 0.15, hook_at = 1.5;
  double apart = 3.0;  // of the two hooks along the edges, m
  double damping_time = 0.02;
  Mechanism mechanism = [] {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -standard_gravity});
    builder.add_body({.name = "load",
                      .joint = {.kind = JointKind::free},
                      .mass = 10e3,
                      .I_BBcm_B = Vector3(4e4, 5e4, 6e4).asDiagonal()});
    return builder.build();
  }();
  RopeDefinition rope() const {
    const auto edge = [&](const char* side, double y) {
      return RopeEdge{.name = side,
                      .body = 1,
                      .begin_B = {-3, y, -1},
                      .end_B = {3, y, -1},
                      .outside_B = {0, y, -2},
                      .radius = radius,
                      .friction = friction};
    };
    return {
        .name = "sling",
        .points = {{world_index, {hook_at, -0.5, 10}}, {world_index, {hook_at - apart, 0.5, 10}}},
        .axial_stiffness = 20e6,
        .damping_time = damping_time,
        .unstretched_length = 26.3,
        .edges = {edge("port", -2), edge("starboard", 2)}};
  }
  LiftSystem build(double duration) const {
    OperationBuilder operation;
    std::vector<Rope> ropes;
    ropes.emplace_back(mechanism, rope());
    Eigen::VectorXd q = mechanism.zero_configuration();
    Mechanism copy = mechanism;
    return LiftSystem({.mechanism = std::move(copy),
                       .ropes = std::move(ropes),
                       .operation = operation.build(duration),
                       .q_start = q});
  }
};

// At one instant of an oblique and turning block.
struct Instant {
  explicit Instant(const ObliqueCradle& of)
      : cradle(of),
        ropes{Rope(of.mechanism, of.rope())},
        path(make_rope_path(ropes)),
        kinematics(of.mechanism),
        split(ropes[0]),
        v(6) {
    v << 0.3, -0.2, 0.1, 0.5, -0.4, 0.2;
    move_to(0.0);
    split.begin(ropes[0], kinematics, path, ropes[0].calc_load(path, {25.5, 0.0}));
  }
  void move_to(double time) {
    Eigen::VectorXd q(7), moved(7);
    cradle.mechanism.integrate(cradle.mechanism.zero_configuration(), v, 0.3, q);
    cradle.mechanism.integrate(q, v, time, moved);
    compute_kinematics(cradle.mechanism, moved, v, kinematics);
    ropes[0].calc_path(kinematics, path);
  }
  RopeLoad divide_at(double time) {
    move_to(time);
    RopeLoad load = ropes[0].calc_load(path, {25.5, 0.0});
    split.divide(ropes[0], kinematics, path, load);
    return load;
  }
  const ObliqueCradle& cradle;
  std::vector<Rope> ropes;
  RopePath path;
  Kinematics kinematics;
  RopeSplit split;
  Eigen::VectorXd v;
};

// The wrap is how far the rope's direction turns along its helix: summed over small steps of it,
// for a sharp edge over those of a round one that is too small to matter.
TEST(EdgeFriction, WrapIsTheCurvatureOfTheHelix) {
  for (const double radius : {0.0, 0.4}) {
    const ObliqueCradle cradle{.radius = radius, .apart = 6.0};
    Instant instant(cradle);
    instant.divide_at(0.0);
    for (const std::size_t bend : {0U, 1U}) {
      const EdgeTouch& touch = instant.path.touches[bend];
      ASSERT_TRUE(touch.touches);
      const Vector3 along = instant.ropes[0].edge_along_W(instant.kinematics, bend);
      const Vector3 u = instant.path.direction_W[radius > 0.0 ? 2 * bend : bend];
      const double slope = u.dot(along);
      ASSERT_GT(std::abs(slope), 0.05);
      const Vector3 across = (u - slope * along).normalized();
      const Vector3 up = along.cross(across);
      constexpr int steps = 2000;
      Vector3 previous = u;
      double turned = 0.0;
      for (int i = 1; i <= steps; ++i) {
        const double angle = touch.winding * touch.wrap * i / steps;
        const Vector3 next = slope * along + std::sqrt(1.0 - slope * slope) *
                                                 (std::cos(angle) * across + std::sin(angle) * up);
        turned += std::asin(previous.cross(next).norm());
        previous = next;
      }
      EXPECT_NEAR(instant.split.wrap(bend), turned, 1e-7);
    }
  }
}

// Tensions, lengths and slip by differences, of oblique edges of a turning body.
TEST(EdgeFriction, RatesAreThoseOfTheLengths) {
  for (const double radius : {0.0, 0.4}) {
    for (const bool slips : {false, true}) {
      const ObliqueCradle cradle{.radius = radius, .damping_time = 0.0};
      Instant instant(cradle);
      instant.divide_at(0.0);
      if (slips) {
        instant.split.set_motion(0, BendMotion::to_first);
        instant.split.set_motion(1, BendMotion::to_last);
      }
      constexpr double h = 1e-5;
      instant.divide_at(h);
      const double ahead = instant.split.unstretched_length(2);
      const double stored_ahead = instant.divide_at(h).split.stored_energy;
      const double stored_behind = instant.divide_at(-h).split.stored_energy;
      const double behind = instant.split.unstretched_length(2);
      const RopeLoad load = instant.divide_at(0.0);
      EXPECT_NEAR(instant.split.slip_rate(1), (ahead - behind) / (2.0 * h), 1e-7);
      // Energy: what the forces spend is lost by what is stored, and by friction.
      std::vector<ForceVector> F(2, ForceVector::zero());
      instant.split.add_forces(instant.path, F);
      const double power = dot(F[1], instant.kinematics.V_WB[1]);
      const double stored_rate = (stored_ahead - stored_behind) / (2.0 * h);
      EXPECT_NEAR(-power, stored_rate + load.split.dissipated_power, 1e-6 * std::abs(power) + 1e-2);
      if (!slips) {
        EXPECT_EQ(load.split.dissipated_power, 0.0);
      }
    }
  }
}

// A load that swings, turns and slides in its sling, with and without rounds: nothing is lost but
// what friction and damping take.
TEST(EdgeFriction, EnergyCloses) {
  for (const double radius : {0.0, 0.3}) {
    for (const double damping_time : {0.0, 0.02}) {
      const ObliqueCradle cradle{
          .radius = radius, .hook_at = 0.4, .apart = 1.0, .damping_time = damping_time};
      const LiftSystem lift = cradle.build(1.5);
      Eigen::VectorXd v(6);
      v << 0.05, -0.02, 0.04, 0.3, -0.5, 0.1;
      const IntegrationResult run =
          integrate(lift, lift.q_start(), v, {.relative_tolerance = 1e-9, .sample_interval = 0.01});
      const EnergyHistory& energy = run.history.energy;
      EXPECT_GE(run.statistics.bend_changes, 2);
      EXPECT_LT(imbalance_of(energy), 1e-6 * energy.kinetic.maxCoeff());
      EXPECT_GT(energy.dissipated.tail(1)[0], 10.0);
      const Eigen::Index n = energy.dissipated.size() - 1;
      EXPECT_TRUE(
          (energy.dissipated.tail(n).array() >= energy.dissipated.head(n).array() - 1e-3).all());
      if (damping_time > 0.0) continue;  // where it sticks, each span is damped by itself
      const EdgeHistory& edge = run.history.ropes[0].edges[1];
      const Eigen::ArrayXd capstan = (0.15 * edge.wrap.array()).exp();
      const Eigen::ArrayXd a = edge.first_tension.array(), b = edge.last_tension.array();
      EXPECT_TRUE((a <= capstan * b * (1.0 + 1e-6) + 10.0).all());
      EXPECT_TRUE((b <= capstan * a * (1.0 + 1e-6) + 10.0).all());
    }
  }
}

// A weight that swings about an edge which its rope leaves and meets again.
TEST(EdgeFriction, EnergyClosesWhereItTouchesAndLeaves) {
  for (const double radius : {0.0, 0.2}) {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -standard_gravity});
    builder.add_body({.name = "weight", .joint = {.kind = JointKind::translational}, .mass = 10e3});
    Mechanism mechanism = builder.build();
    const RopeDefinition rope{.name = "rope",
                              .points = {{world_index, {0, 0, 4}}, {1, Vector3::Zero()}},
                              .axial_stiffness = 40e6,
                              .damping_time = 0.01,
                              .unstretched_length = 10.0,
                              .edges = {{.name = "edge",
                                         .begin_B = {0.05, -1, 0},
                                         .end_B = {0.05, 1, 0},
                                         .outside_B = {-1, 0, 0},
                                         .radius = radius,
                                         .friction = 0.3}}};
    std::vector<Rope> ropes;
    ropes.emplace_back(mechanism, rope);
    OperationBuilder operation;
    const Eigen::Vector3d q(-2.0, 0.3, 4.0 - std::sqrt(10.02 * 10.02 - 4.0 - 0.09));
    const LiftSystem lift({.mechanism = std::move(mechanism),
                           .ropes = std::move(ropes),
                           .operation = operation.build(12.0),
                           .q_start = q});
    const IntegrationResult run = integrate(lift, lift.q_start(), Eigen::Vector3d(0, 0.1, 0),
                                            {.relative_tolerance = 1e-9, .sample_interval = 0.01});
    const EdgeHistory& edge = run.history.ropes[0].edges[0];
    int touches = 0;
    for (Eigen::Index i = 1; i < edge.wrap.size(); ++i)
      touches += edge.touches(i) && !edge.touches(i - 1) ? 1 : 0;
    EXPECT_GE(touches, 2);
    EXPECT_GE(run.statistics.bend_changes, 4);
    EXPECT_LT(run.statistics.bend_changes, 2000);
    EXPECT_LT(imbalance_of(run.history.energy), 1e-6 * run.history.energy.kinetic.maxCoeff());
  }
}

// Hardly any friction is none.
TEST(EdgeFriction, VanishesWithTheCoefficient) {
  const auto run = [](double friction) {
    const ObliqueCradle cradle{.radius = 0.3, .friction = friction, .hook_at = 0.4, .apart = 1.0};
    const LiftSystem lift = cradle.build(1.0);
    Eigen::VectorXd v(6);
    v << 0.05, -0.02, 0.04, 0.3, -0.5, 0.1;
    return integrate(lift, lift.q_start(), v, {.relative_tolerance = 1e-10});
  };
  const IntegrationResult with = run(1e-8), without = run(0.0);
  EXPECT_LT((with.q_end - without.q_end).norm(), 1e-5);
  EXPECT_EQ(without.statistics.bend_changes, 0);
}

TEST(EdgeFriction, AllocatesNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not counted in this build";
  for (const double radius : {0.0, 0.3}) {
    const ObliqueCradle cradle{.radius = radius};
    const LiftSystem lift = cradle.build(1.0);
    LiftWorkspace w(lift);
    Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
    get_state(lift, lift.q_start(), Eigen::VectorXd::Constant(6, 0.1), y);
    const Contacts contacts{1};
    calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
    lift.ropes()[0].calc_path(w.kinematics, w.path);
    w.splits[0].begin(lift.ropes()[0], w.kinematics, w.path, w.rope_loads[0]);
    calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
    for (const BendMotion motion : {BendMotion::sticks, BendMotion::to_last}) {
      w.splits[0].set_motion(0, motion);
      const long before = blocklift::test::allocations();
      double sum = 0.0;
      for (int i = 0; i < 10; ++i) {
        calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
        w.splits[0].carry(lift.ropes()[0], w.kinematics, w.path);
        sum += w.splits[0].indicator(0) + calc_energy_rates(lift, 0.0, w).dissipated_power;
      }
      EXPECT_EQ(blocklift::test::allocations(), before);
      EXPECT_TRUE(std::isfinite(sum));
    }
  }
}

TEST(EdgeFriction, JacobianIsThatOfTheForces) {
  for (const double radius : {0.0, 0.4}) {
    const ObliqueCradle cradle{.radius = radius};
    const LiftSystem lift = cradle.build(1.0);
    Eigen::VectorXd q(7), v(6);
    v << 0.1, -0.2, 0.1, 0.2, -0.1, 0.2;
    lift.mechanism().integrate(lift.q_start(), v, 0.5, q);
    test::expect_jacobian_of_split(lift, q, v);
  }
}

TEST(EdgeFriction, RefusesWhatHasNoMeaning) {
  const ObliqueCradle cradle{.friction = -0.1};
  EXPECT_THAT([&] { Rope(cradle.mechanism, cradle.rope()); },
              ThrowsMessage<ModelError>(HasSubstr("edge \"port\" has the friction")));
}

}  // namespace
}  // namespace blocklift::dynamics
