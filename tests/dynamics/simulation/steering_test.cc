// Drives that follow a wish, against closed forms.
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/steersman.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/rope_lifts.h"
#include "tests/dynamics/allocation_counter.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr MotionLimits drive_can{0.2, 0.1, 0.4};

// Its acceleration and jerk keep to their limits, its speed does not pass the one that is wanted
// and is there in little more than the least time: v / a + a / j, or 2 sqrt(v / j) where the
// largest acceleration is not reached.
TEST(Steering, GoesOverToASpeedWithinItsLimits) {
  constexpr double h = 0.2;
  for (const MotionLimits& can : {drive_can, MotionLimits{0.2, 10.0, 0.1}}) {
    SteeredMotion motion;
    double time = 0.0;
    while (std::abs(motion.speed - 0.2) > 1e-3 * 0.2) {
      const double next = find_next_acceleration(motion, 0.2, h, can);
      EXPECT_LE(std::abs(next - motion.acceleration), can.jerk * h * (1 + 1e-12));
      EXPECT_LE(std::abs(next), can.acceleration * (1 + 1e-12));
      motion = advance(motion, next, h);
      EXPECT_LE(motion.speed, 0.2 * (1 + 1e-12));
      time += h;
      ASSERT_LT(time, 20.0);
    }
    const double peak = std::min(can.acceleration, std::sqrt(0.2 * can.jerk));
    EXPECT_LT(time, 0.2 / peak + peak / can.jerk + 4 * h);
  }
}

TEST(Steering, LooksFitTheReaction) {
  Steering steering;
  steering.reaction = 0.5;
  EXPECT_EQ(steering.looks_behind(), 3);
  EXPECT_NEAR(steering.interval() * 3, 0.5, 1e-15);
  steering.reaction = 0.0;
  EXPECT_EQ(steering.looks_behind(), 0);
  EXPECT_EQ(steering.interval(), 0.2);
}

// A course of constant jerk goes t^3 / 6 j, then keeps its speed.
TEST(Steering, ACourseIsACubicInTime) {
  const MotionProfile profile = MotionProfile::along(Course{1.0, 0.5, {0.0, 0.2, 0.4, 0.0}});
  EXPECT_EQ(profile.evaluate(0.5).position, 0.0);
  EXPECT_NEAR(profile.evaluate(1.8).position, 0.4 * std::pow(0.8, 3) / 6, 1e-15);
  EXPECT_NEAR(profile.evaluate(1.8).velocity, 0.4 * 0.8 * 0.8 / 2, 1e-15);
  EXPECT_NEAR(profile.evaluate(1.8).acceleration, 0.4 * 0.8, 1e-15);
  EXPECT_NEAR(profile.evaluate(5.0).velocity, 0.2 + 0.1, 1e-15);
  EXPECT_NEAR(profile.evaluate(6.0).position - profile.evaluate(5.0).position, 0.3, 1e-15);
}

/// Two loads of 10 t, each on its own rope of 20 m from the world, at x = 0 and 10 m; the first is
/// moved, the second steered.
struct LeaderAndFollower {
  BodyIndex first = -1, second = -1;
  Mechanism mechanism;
  std::vector<Rope> ropes;
  OperationBuilder operation;

  LeaderAndFollower() : mechanism(make()) {
    for (int i = 0; i < 2; ++i) {
      const std::string name = i == 0 ? "first" : "second";
      ropes.emplace_back(mechanism, RopeDefinition{.name = name,
                                                   .points = {{world_index, {10.0 * i, 0, 0}},
                                                              {i == 0 ? first : second, {0, 0, 0}}},
                                                   .axial_stiffness = 40e6,
                                                   .damping_time = 0.05,
                                                   .unstretched_length = 20.0});
      operation.add_winch(name, i, 20.0);
    }
  }

  Mechanism make() {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -examples::g});
    first = builder.add_body(
        {.name = "first", .joint = {.kind = JointKind::translational}, .mass = 10e3});
    second = builder.add_body(
        {.name = "second", .joint = {.kind = JointKind::translational}, .mass = 10e3});
    return builder.build();
  }

  Steering keep_level(double end) const {
    Steering steering;
    steering.wish = KeptHeight{{second, {0, 0, 0}}, {first, {0, 0, 0}}, 0.0};
    steering.start = 0.0;
    steering.end = end;
    steering.correction_time = 4.0;
    steering.limits = drive_can;
    steering.lowest = 1.0;
    steering.highest = 60.0;
    return steering;
  }

  LiftSystem build(double duration) const {
    Eigen::VectorXd q(6);
    q << 0, 0, -20, 10, 0, -20;
    return LiftSystem({.mechanism = mechanism,
                       .ropes = ropes,
                       .operation = operation.build(duration),
                       .q_start = q});
  }
};

IntegrationResult run_from_rest(const LiftSystem& lift) {
  Eigen::VectorXd q = lift.q_start();
  EquilibriumSolver(lift).solve(0, q);
  return integrate(lift, q, lift.v_start(), {.relative_tolerance = 1e-8});
}

double height_of(const History& history, const char* body, Eigen::Index sample) {
  return history.body(body).X_WB(sample).p.z();
}

Eigen::Index sample_near(const History& history, double t) {
  Eigen::Index sample = 0;
  (history.time.array() - t).abs().minCoeff(&sample);
  return sample;
}

// Behind a load that sinks at the speed V it lags by V times its correction time and by its
// tolerance, whatever its reaction; when the other stands, only the tolerance is left. Replayed as
// a course, known beforehand, the motion is the same.
TEST(Steering, LagsByTheSpeedTimesTheCorrectionTime) {
  constexpr double speed = 0.05;
  for (const double reaction : {0.0, 1.0}) {
    LeaderAndFollower parts;
    parts.operation.add_move("first", {0.0, 3.0, {speed, 0.05, 0.2}});
    Steering steering = parts.keep_level(100.0);
    steering.reaction = reaction;
    steering.tolerance = 0.02;
    parts.operation.add_steering("second", steering);
    const LiftSystem lift = parts.build(130.0);
    const IntegrationResult result = run_from_rest(lift);
    const History& history = result.history;
    const Eigen::Index moving = sample_near(history, 55.0), last = history.sample_count() - 1;
    EXPECT_NEAR(height_of(history, "second", moving) - height_of(history, "first", moving),
                speed * 4.0 + 0.02, 1e-4);
    EXPECT_NEAR(height_of(history, "second", last) - height_of(history, "first", last), 0.02, 1e-4);
    ASSERT_EQ(result.courses.size(), 1u);

    LeaderAndFollower replayed;
    replayed.operation.add_move("first", {0.0, 3.0, {speed, 0.05, 0.2}});
    replayed.operation.add_course("second", result.courses[0], steering.stand());
    const IntegrationResult again = run_from_rest(replayed.build(130.0));
    const auto difference =
        (again.history.body("second").pose - history.body("second").pose).cwiseAbs().maxCoeff();
    EXPECT_LT(difference, 1e-6);
    const EnergyHistory& e = again.history.energy;
    const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
    EXPECT_LT((energy - energy[0] - (e.drive_work + e.winch_work - e.dissipated).array())
                  .abs()
                  .maxCoeff(),
              1e-6 * 10e3 * examples::g);
  }
}

// A drive that is not to be seen to act before the reaction is over does not.
TEST(Steering, ActsAfterTheReaction) {
  LeaderAndFollower parts;
  parts.operation.add_move("first", {0.0, 3.0, {1.0, 10.0, 100.0}});
  Steering steering = parts.keep_level(60.0);
  steering.reaction = 2.0;
  parts.operation.add_steering("second", steering);
  const History history = run_from_rest(parts.build(90.0)).history;
  const Eigen::VectorXd& length = history.rope("second").unstretched_length;
  // What is seen at 0.2 s is acted on from 2.2 s on.
  EXPECT_NEAR(length[sample_near(history, 2.2)], 20.0, 1e-9);
  EXPECT_GT(length[sample_near(history, 2.6)], 20.0 + 1e-6);
  // Far away it goes at its largest speed.
  EXPECT_NEAR(history.rope("second").unstretched_rate.maxCoeff(), drive_can.speed, 1e-9);
  EXPECT_NEAR(length[length.size() - 1], 23.0, 1e-4);
}

// It brakes before it leaves its range, and stands at its end.
TEST(Steering, StaysWithinTheRange) {
  LeaderAndFollower parts;
  parts.operation.add_move("first", {0.0, 5.0, {0.5, 0.5, 2.0}});
  Steering steering = parts.keep_level(60.0);
  steering.highest = 22.0;
  parts.operation.add_steering("second", steering);
  const History history = run_from_rest(parts.build(90.0)).history;
  const Eigen::VectorXd& length = history.rope("second").unstretched_length;
  EXPECT_LE(length.maxCoeff(), 22.0 + 1e-6);
  EXPECT_NEAR(length[length.size() - 1], 22.0, 1e-3);
  EXPECT_NEAR(history.rope("second").unstretched_rate.tail(1)[0], 0.0, 1e-12);
}

// An emergency stop overrules it: half the stop's time at the speed that it had.
TEST(Steering, IsStopped) {
  LeaderAndFollower parts;
  parts.operation.add_move("first", {0.0, 5.0, {0.5, 0.5, 2.0}});
  parts.operation.add_steering("second", parts.keep_level(60.0));
  parts.operation.add_stop("second", 10.0, 1.0);
  const History history = run_from_rest(parts.build(90.0)).history;
  const Eigen::VectorXd& length = history.rope("second").unstretched_length;
  const double before = length[sample_near(history, 10.0)];
  EXPECT_NEAR(length[length.size() - 1], before + 0.5 * drive_can.speed, 1e-9);
}

/// A pendulum on a rope from a trolley that is steered.
struct Pendulum {
  static constexpr double length = 10.0, stretch = 10e3 * examples::g * length / 400e6;  // m
  static constexpr double correction = 8.0;                                              // s
  static double period() {
    return 2 * std::numbers::pi * std::sqrt((length + stretch) / examples::g);
  }

  BodyIndex trolley = -1, load = -1;
  Mechanism mechanism;

  Pendulum() : mechanism(make()) {}

  Mechanism make() {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -examples::g});
    BodyDefinition definition;
    definition.name = "trolley";
    definition.mass = 1.0;
    definition.joint.kind = JointKind::prismatic;
    definition.joint.axis = Vector3::UnitX();
    definition.driven = {true};
    trolley = builder.add_body(definition);
    load = builder.add_body(
        {.name = "load", .joint = {.kind = JointKind::translational}, .mass = 10e3});
    return builder.build();
  }

  Steering steering(Wish wish) const {
    Steering steering;
    steering.wish = std::move(wish);
    steering.start = 0.0;
    steering.end = 60.0;
    steering.correction_time = correction;
    steering.limits = {10.0, 100.0, 1000.0};
    steering.lowest = -50.0;
    steering.highest = 50.0;
    return steering;
  }

  History run(const Steering& steering) const {
    std::vector<Rope> ropes;
    ropes.emplace_back(mechanism,
                       RopeDefinition{.name = "rope",
                                      .points = {{trolley, {0, 0, 0}}, {load, {0, 0, 0}}},
                                      .axial_stiffness = 400e6,
                                      .damping_time = 0.05,
                                      .unstretched_length = length});
    OperationBuilder operation;
    operation.add_joint_drive(mechanism, "trolley", trolley, 0.0);
    operation.add_steering("trolley", steering);
    Eigen::VectorXd q(4);
    q << 0, 0.05, 0, -length - stretch;
    const LiftSystem lift(
        {.mechanism = mechanism, .ropes = ropes, .operation = operation.build(70.0), .q_start = q});
    return integrate(lift, q, lift.v_start(), {.relative_tolerance = 1e-8}).history;
  }

  /// Logarithm of the ratio of the swings of two periods, three periods apart.
  static double decay(const History& history) {
    const auto swing = [&](double from, double to) {
      double largest = 0.0;
      for (Eigen::Index i = 0; i < history.sample_count(); ++i)
        if (history.time[i] >= from && history.time[i] < to)
          largest = std::max(largest, std::abs(history.body("load").X_WB(i).p.x() -
                                               history.body("trolley").X_WB(i).p.x()));
      return largest;
    };
    return std::log(swing(period(), 2 * period()) / swing(4 * period(), 5 * period()));
  }
};

// x'' = -omega^2 (x - y), y' = (x - y) / T give d'' + d' / T + omega^2 d = 0 for d = x - y. What is
// seen is acted on an interval and a half of 0.2 s later, a twentieth of a period, and the largest
// swing of a window is not its envelope: 8 % by a march of these two equations with the same looks.
TEST(Steering, APlumbTrolleyTakesTheSwingOutOfAPendulum) {
  const Pendulum pendulum;
  const double decay = Pendulum::decay(pendulum.run(
      pendulum.steering(KeptPlumb{{pendulum.trolley, {0, 0, 0}}, {pendulum.load, {0, 0, 0}}})));
  EXPECT_NEAR(decay, 3 * Pendulum::period() / (2 * Pendulum::correction), 0.1 * decay);
}

/// A law that sees two figures and gives its speed by a function of the time and these.
OwnLaw own_law(std::vector<Sight> sights, SpeedLaw law) {
  return {"own", std::move(sights), [law = std::move(law)] { return law; }};
}

// A proportional law from outside, y' = d / T, is the same equation; with looks every 0.02 s it
// acts a tenth as late, and comes ten times as near.
TEST(Steering, AProportionalLawDampsAPendulum) {
  const Pendulum pendulum;
  Steering steering = pendulum.steering(
      own_law({SeenPlumb{{pendulum.trolley, {0, 0, 0}}, {pendulum.load, {0, 0, 0}}}},
              [](double, std::span<const double> seen) { return seen[0] / Pendulum::correction; }));
  steering.longest_interval = 0.02;
  const double decay = Pendulum::decay(pendulum.run(steering));
  EXPECT_NEAR(decay, 3 * Pendulum::period() / (2 * Pendulum::correction), 0.02 * decay);
}

// A law that asks for what the built-in wish asks for moves the drive alike.
TEST(Steering, ALawThatKeepsLevelIsTheBuiltInOne) {
  const auto run = [](bool by_law) {
    LeaderAndFollower parts;
    parts.operation.add_move("first", {0.0, 3.0, {0.05, 0.05, 0.2}});
    Steering steering = parts.keep_level(80.0);
    steering.reaction = 0.5;
    if (by_law)
      steering.wish = own_law({SeenHeight{{parts.second, {0, 0, 0}}, {parts.first, {0, 0, 0}}}},
                              [](double, std::span<const double> seen) { return seen[0] / 4.0; });
    parts.operation.add_steering("second", steering);
    return run_from_rest(parts.build(110.0)).history;
  };
  const History built_in = run(false), own = run(true);
  EXPECT_LT((own.body("second").pose - built_in.body("second").pose).cwiseAbs().maxCoeff(), 1e-12);
}

// Towards a length by its own coordinate: L' = (goal - L) / T decays by exp(-t / T), later by an
// interval and a half: lambda = exp(lambda 1.5 h) / T. It sees its rate, too.
TEST(Steering, AWinchGoesToALengthByALaw) {
  constexpr double goal = 22.0, correction = 5.0, interval = 0.05;
  LeaderAndFollower parts;
  Steering steering = parts.keep_level(60.0);
  steering.limits = {1.0, 10.0, 100.0};
  steering.longest_interval = interval;
  double fastest = 0.0;
  steering.wish =
      own_law({SeenCoordinate{}, SeenRate{}}, [&](double, std::span<const double> seen) {
        fastest = std::max(fastest, seen[1]);
        return (goal - seen[0]) / correction;
      });
  parts.operation.add_steering("second", steering);
  const History history = run_from_rest(parts.build(90.0)).history;
  const Eigen::VectorXd& length = history.rope("second").unstretched_length;
  const double left_at_10 = goal - length[sample_near(history, 10.0)];
  const double left_at_30 = goal - length[sample_near(history, 30.0)];
  double rate = 1.0 / correction;
  for (int i = 0; i < 20; ++i) rate = std::exp(rate * 1.5 * interval) / correction;
  EXPECT_NEAR(std::log(left_at_10 / left_at_30) / 20.0, rate, 1e-3 * rate);
  EXPECT_NEAR(fastest, history.rope("second").unstretched_rate.maxCoeff(), 1e-3);
}

// It is asked at even instants from the start to the end, begins anew with each run, and what it
// gives acts after the reaction.
TEST(Steering, ALawIsAskedAtItsLooks) {
  LeaderAndFollower parts;
  Steering steering = parts.keep_level(3.0);
  steering.start = 1.0;
  steering.reaction = 0.5;
  steering.longest_interval = 0.3;
  std::vector<double> times;
  int begun = 0;
  steering.wish = OwnLaw{"own", {}, [&]() -> SpeedLaw {
                           ++begun;
                           return [&](double time, std::span<const double> seen) {
                             EXPECT_TRUE(seen.empty());
                             times.push_back(time);
                             return 0.1;
                           };
                         }};
  parts.operation.add_steering("second", steering);
  const LiftSystem lift = parts.build(30.0);
  const History history = run_from_rest(lift).history;
  ASSERT_EQ(times.size(), 8u);  // every 0.25 s, twice in the reaction
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(times[i], 1.0 + 0.25 * static_cast<double>(i), 1e-9);
  const Eigen::VectorXd& length = history.rope("second").unstretched_length;
  EXPECT_NEAR(length[sample_near(history, 1.5)], 20.0, 1e-12);
  EXPECT_GT(length[sample_near(history, 1.8)], 20.0 + 1e-6);
  EXPECT_EQ(begun, 1);
  run_from_rest(lift);
  EXPECT_EQ(begun, 2);
}

TEST(Steering, WhatALawThrowsArrivesUnchanged) {
  struct Anything {
    int number;
  };
  const auto run = [](SpeedLaw law) {
    LeaderAndFollower parts;
    Steering steering = parts.keep_level(3.0);
    steering.wish = own_law({}, std::move(law));
    parts.operation.add_steering("second", steering);
    run_from_rest(parts.build(30.0));
  };
  try {
    run([](double, std::span<const double>) -> double { throw Anything{7}; });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Anything& thrown) {
    EXPECT_EQ(thrown.number, 7);
  }
  EXPECT_THAT([&] { run([](double, std::span<const double>) { return not_a_number; }); },
              ThrowsMessage<SimulationError>(HasSubstr("law \"own\" gave drive \"second\"")));
}

// A winch between the world and a body on a spring holds the tension that it is asked for, or the
// share of two ropes.
TEST(Steering, HoldsATensionAndAShare) {
  constexpr double spring = 1e6;  // N/m
  for (const bool by_share : {false, true}) {
    MechanismBuilder builder;
    BodyDefinition definition;
    definition.name = "load";
    definition.mass = 1e3;
    definition.joint.kind = JointKind::prismatic;
    definition.joint.axis = Vector3::UnitX();
    const BodyIndex load = builder.add_body(definition);
    const Mechanism mechanism = builder.build();
    std::vector<Rope> ropes;
    for (const double side : {-1.0, 1.0})
      ropes.emplace_back(mechanism, RopeDefinition{.name = side < 0 ? "left" : "right",
                                                   .points = {{world_index, {10.0 * side, 0, 0}},
                                                              {load, {0, 0, 0}}},
                                                   .axial_stiffness = 20e6,
                                                   .damping_time = 0.05,
                                                   .unstretched_length = 9.98});
    ForceElements elements;
    std::get<std::vector<JointSpring>>(elements).emplace_back(
        mechanism, JointSpring::Definition{.name = "spring",
                                           .body = load,
                                           .stiffness = spring,
                                           .damping = 2e4,
                                           .free_coordinate = 0.0});
    OperationBuilder operation;
    operation.add_winch("left", 0, 9.98);
    operation.add_winch("right", 1, 9.98);
    Steering steering;
    if (by_share)
      steering.wish = KeptShare{0, {1}, 0.45, 6e5};
    else
      steering.wish = KeptTension{0, 60e3, {}};
    steering.start = 1.0;
    steering.end = 60.0;
    steering.correction_time = 2.0;
    steering.reaction = 0.5;
    steering.limits = drive_can;
    steering.lowest = 5.0;
    steering.highest = 15.0;
    operation.add_steering("left", steering);
    const LiftSystem lift({.mechanism = mechanism,
                           .ropes = ropes,
                           .elements = elements,
                           .operation = operation.build(80.0),
                           .q_start = Eigen::VectorXd::Zero(1)});
    const History history = run_from_rest(lift).history;
    const double left = history.rope("left").tension.tail(1)[0];
    const double right = history.rope("right").tension.tail(1)[0];
    EXPECT_NEAR(history.rope("left").tension[0], 40e3, 100.0);
    if (by_share)
      EXPECT_NEAR(left / (left + right), 0.45, 1e-6);
    else
      EXPECT_NEAR(left, 60e3, 1.0);
  }
}

TEST(Steering, AllocatesNothingInTheRightHandSide) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not in this build";
  LeaderAndFollower parts;
  parts.operation.add_steering("second", parts.keep_level(10.0));
  const LiftSystem lift = parts.build(60.0);
  LiftWorkspace w(lift);
  w.steered[0] = MotionProfile::along(Course{0.0, 0.2, {0.0, 0.1, 0.1, 0.0}});
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, lift.q_start(), lift.v_start(), y);
  const Contacts contacts(2, 1);
  calc_right_hand_side(lift, 0.3, y, &contacts, w, ydot);
  const long before = blocklift::test::allocations();
  calc_right_hand_side(lift, 0.4, y, &contacts, w, ydot);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

TEST(Steering, RefusesWhatCannotBe) {
  LeaderAndFollower parts;
  const auto refuses = [&](auto change, const char* message) {
    Steering steering = parts.keep_level(10.0);
    change(steering);
    EXPECT_THAT([&] { parts.operation.add_steering("second", steering); },
                ThrowsMessage<ModelError>(HasSubstr(message)));
  };
  refuses([](Steering& s) { s.correction_time = 0.0; }, "must be positive");
  refuses([](Steering& s) { s.reaction = -1.0; }, "negative");
  refuses([](Steering& s) { s.end = -1.0; }, "\"second\" cannot be steered: it would be from");
  refuses([](Steering& s) { s.lowest = 100.0; }, "no range");
  refuses([](Steering& s) { s.wish = KeptTension{0, 1.0, {}}; }, "its own rope");
  refuses([](Steering& s) { s.wish = KeptShare{1, {}, 0.5, {}}; }, "one of several");
  refuses([](Steering& s) { s.wish = KeptPlumb{}; }, "winches keep heights");
  refuses([](Steering& s) { s.wish = OwnLaw{}; }, "its law is missing");
  refuses([](Steering& s) { s.wish = own_law({SeenPlumb{}}, {}); }, "sees no plumb");
  refuses([](Steering& s) { s.longest_interval = 0.0; }, "must be positive");
  parts.operation.add_steering("second", parts.keep_level(10.0));
  refuses([](Steering&) {}, "steered twice");
}

}  // namespace
}  // namespace blocklift::dynamics
