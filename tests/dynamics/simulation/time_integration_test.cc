#include "dynamics/simulation/time_integration.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using examples::g;

Eigen::VectorXd at_height(double z) { return Vector3(0, 0, z); }

double largest_imbalance(const EnergyHistory& e) {
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work + e.outside_work - e.dissipated;
  return (energy - energy[0] - work).abs().maxCoeff();
}

// A load on a rope oscillates about its rest with the period 2 pi sqrt(m L / EA).
TEST(TimeIntegration, HangingLoadOscillatesWithItsPeriod) {
  const examples::SingleRopeLift model;
  const LiftSystem lift = model.build();
  const double omega = std::sqrt(model.axial_stiffness / (model.length * model.mass));
  const double rest = -model.length - model.mass * g / model.stiffness();
  constexpr double amplitude = 0.01;
  const IntegrationResult run =
      integrate(lift, at_height(rest - amplitude), lift.v_start(), {.relative_tolerance = 1e-10});
  for (Eigen::Index i = 0; i < run.history.sample_count(); ++i) {
    const double t = run.history.time[i];
    // The phase error grows with time; the tolerance is 1e-5 of the amplitude over 4.5 periods.
    EXPECT_NEAR(run.history.bodies[0].pose(i, 2), rest - amplitude * std::cos(omega * t), 1e-7);
  }
  EXPECT_EQ(run.statistics.contact_changes, 0);
}

// T = m g (1 - cos(omega t)): the peak is twice the weight, and the rope just stays taut.
TEST(TimeIntegration, LoadLetGoAtUnstretchedLengthPeaksAtTwiceItsWeight) {
  const examples::SingleRopeLift model;
  const LiftSystem lift = model.build();
  const double omega = std::sqrt(model.stiffness() / model.mass);
  const double weight = model.mass * g;
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-10, .sample_interval = 0.002});
  const Eigen::ArrayXd expected = weight * (1.0 - (omega * run.history.time.array()).cos());
  EXPECT_LT((run.history.ropes[0].tension.array() - expected).abs().maxCoeff(), 1e-5 * weight);
  EXPECT_NEAR(find_largest_tensions(run.history)[0].tension, 2.0 * weight, 2e-4 * weight);
}

// A hoist at the speed v that grips at once: T / (m g) = 1 + v sqrt(k / (m g^2)) at its peak.
TEST(TimeIntegration, HoistThatGripsAtOnce) {
  constexpr double speed = 0.05;
  examples::SingleRopeLift model;
  model.payout = -0.05;
  model.payout_start = 0.5;
  model.limits = examples::abrupt(speed);
  const LiftSystem lift = model.build();
  const double rest = -model.length - model.mass * g / model.stiffness();
  const IntegrationResult run = integrate(lift, at_height(rest), lift.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.001});
  const double factor = 1.0 + speed * std::sqrt(model.stiffness() / (model.mass * g * g));
  // The first peak comes after T/4 = 0.11 s, when the rope is 6 mm of 20 m shorter: k is 3e-4
  // stiffer at most.
  const double peak = run.history.ropes[0].tension.segment(500, 250).maxCoeff();
  EXPECT_NEAR(peak / (model.mass * g), factor, 3e-4);
  EXPECT_NEAR(run.history.ropes[0].tension[400] / (model.mass * g), 1.0, 1e-7);
  EXPECT_LT(largest_imbalance(run.history.energy), 1e-6 * model.mass * g);
}

// A run that goes on from an instant of another goes on as the other did.
TEST(TimeIntegration, GoesOnFromAnInstantOfAnotherRun) {
  examples::SingleRopeLift model;
  model.damping_time = 5e-3;
  model.payout = -4.0;
  model.duration = 10.0;
  const LiftSystem lift = model.build();
  std::optional<Departure> departure;
  IntegrationSettings settings{.relative_tolerance = 1e-10};
  settings.observe = [&](Eigen::Index, double time, const LiftWorkspace& w) {
    if (std::abs(time - 4.0) < 1e-9) departure = Departure::of(time, w);
  };
  const Vector3 start(3.0, 0, -19.0);
  const IntegrationResult whole = integrate(lift, start, lift.v_start(), settings);
  ASSERT_TRUE(departure);
  settings.observe = {};
  settings.departure = &*departure;
  const IntegrationResult rest = integrate(lift, start, lift.v_start(), settings);
  EXPECT_LT((whole.q_end - rest.q_end).norm(), 1e-6);
  const Eigen::Index first = whole.history.sample_count() - rest.history.sample_count();
  EXPECT_NEAR(rest.history.time[0], 4.0, 1e-9);
  EXPECT_LT((whole.history.ropes[0].tension.tail(rest.history.sample_count()) -
             rest.history.ropes[0].tension)
                .cwiseAbs()
                .maxCoeff(),
            1e-5 * model.mass * g);
  EXPECT_EQ(whole.history.time[first], rest.history.time[0]);
  departure->time = 20.0;
  EXPECT_THAT([&] { integrate(lift, start, lift.v_start(), settings); },
              ThrowsMessage<ModelError>(HasSubstr("cannot go on from")));
}

// Thrown upwards the load flies free, falls into its rope and is thrown up again: times of the
// changes in closed form, tan(phi / 2) = -u omega / g for the end of the taut arc phi.
TEST(TimeIntegration, RopeGoesSlackAndTautAtItsInstants) {
  const examples::SingleRopeLift model;
  const LiftSystem lift = model.build();
  constexpr double u = 1.0;
  const IntegrationResult run =
      integrate(lift, lift.q_start(), Vector3(0, 0, u), {.relative_tolerance = 1e-10});
  const double omega = std::sqrt(model.stiffness() / model.mass);
  const double flight = 2.0 * u / g;
  const double arc = 2.0 * (std::numbers::pi - std::atan(u * omega / g)) / omega;
  ASSERT_GE(run.events.size(), 4u);
  const double times[] = {flight, flight + arc, 2 * flight + arc, 2 * (flight + arc)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(run.events[i].time, times[i], 1e-8);
    EXPECT_EQ(run.events[i].acts, i % 2 == 0);
  }
  EXPECT_GE(run.history.ropes[0].tension.minCoeff(), 0.0);
  EXPECT_LT(largest_imbalance(run.history.energy), 1e-6 * model.mass * g);
}

// How ropes stand at a step's end is mostly known from its last right-hand side. A run that waits
// for what never comes computes it each time: changes come at the same instants, and the motion is
// the same.
TEST(TimeIntegration, ForeseenContactsAreThoseOfTheState) {
  const examples::SingleRopeLift model;
  const LiftSystem lift = model.build();
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    IntegrationSettings settings{.relative_tolerance = tolerance};
    const auto run = [&] { return integrate(lift, lift.q_start(), Vector3(0.3, 0, 1), settings); };
    const IntegrationResult foreseen = run();
    settings.awaited = AwaitedCondition{
        .kind = AwaitedCondition::Kind::pads_at_least, .body = 1, .force = 1e15, .until = 1e9};
    const IntegrationResult computed = run();
    EXPECT_FALSE(computed.met);
    EXPECT_EQ(foreseen.statistics.steps, computed.statistics.steps);
    ASSERT_GE(foreseen.events.size(), 4u);
    ASSERT_EQ(foreseen.events.size(), computed.events.size());
    for (std::size_t i = 0; i < foreseen.events.size(); ++i) {
      EXPECT_NEAR(foreseen.events[i].time, computed.events[i].time, 1e-9);
      EXPECT_EQ(foreseen.events[i].acts, computed.events[i].acts);
    }
    EXPECT_LT((foreseen.q_end - computed.q_end).norm(), 1e-8);
  }
}

// Swinging while it is hoisted, against the polar equations
//   r'' = r theta'^2 + g cos theta - T/m,   theta'' = -(2 r' theta' + g sin theta) / r
// integrated here by classical Runge-Kutta.
TEST(TimeIntegration, SwingingLoadHoistedAgainstMinimalCoordinates) {
  examples::SingleRopeLift model;
  model.damping_time = 5e-3;
  model.payout = -8.0;
  model.duration = 10.0;
  const LiftSystem lift = model.build();
  const MotionProfile& feed = lift.operation().winches()[0].length;
  using State = Eigen::Vector4d;  // r, theta, rates
  const auto rate = [&](double t, const State& s) -> State {
    const ProfileValue L0 = feed.evaluate(t);
    const double k = model.axial_stiffness / L0.position;
    const double tension = k * (s[0] - L0.position) + model.damping_time * k * (s[2] - L0.velocity);
    return {s[2], s[3], s[0] * s[3] * s[3] + g * std::cos(s[1]) - tension / model.mass,
            -(2 * s[2] * s[3] + g * std::sin(s[1])) / s[0]};
  };
  const double r0 = model.length + model.mass * g / model.stiffness();
  constexpr double theta0 = 0.3;
  State s(r0, theta0, 0, 0);
  constexpr int steps = 40000;
  constexpr double h = 10.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const State k1 = rate(t, s), k2 = rate(t + h / 2, s + h / 2 * k1),
                k3 = rate(t + h / 2, s + h / 2 * k2), k4 = rate(t + h, s + h * k3);
    s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const Vector3 start(r0 * std::sin(theta0), 0, -r0 * std::cos(theta0));
  const IntegrationResult run =
      integrate(lift, start, lift.v_start(), {.relative_tolerance = 1e-10});
  const Vector3 expected(s[0] * std::sin(s[1]), 0, -s[0] * std::cos(s[1]));
  EXPECT_LT((run.q_end - expected).norm(), 1e-6);
  EXPECT_LT(largest_imbalance(run.history.energy), 1e-6 * model.mass * g);
}

// Two equal ropes hold a load, W / 2 each. When one parts the other, stretched by W / 2k, must hold
// W, for which it stretches by W / k: the load swings about that place by W / 2k, so that the rope
// carries 3/2 W at most. What the parted one had stored, (W / 2)^2 / 2k, is lost.
TEST(TimeIntegration, ARopeThatPartsLeavesItsLoadToTheOther) {
  MechanismBuilder mechanism_builder;
  mechanism_builder.set_gravity({0, 0, -g});
  constexpr double mass = 2000, length = 10, stiffness = 4e6;
  mechanism_builder.add_body(
      {.name = "load", .joint = {.kind = JointKind::translational}, .mass = mass});
  const Mechanism mechanism = mechanism_builder.build();
  std::vector<Rope> ropes;
  for (const char* name : {"first", "second"}) {
    RopeDefinition rope;
    rope.name = name;
    rope.points = {{world_index, Vector3::Zero()}, {1, Vector3::Zero()}};
    rope.axial_stiffness = stiffness * length;
    rope.unstretched_length = length;
    ropes.emplace_back(mechanism, rope);
  }
  OperationBuilder operation;
  operation.add_stage("hang", 0, 4);
  operation.add_parting(1, 1.0);
  const double weight = mass * g;
  const Vector3 start(0, 0, -length - weight / (2 * stiffness));
  const LiftSystem lift(
      {.mechanism = mechanism, .ropes = ropes, .operation = operation.build(4), .q_start = start});
  const IntegrationResult run = integrate(lift, start, Vector3::Zero(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 5e-4});
  const History& history = run.history;
  const double stored = 0.25 * weight * weight / (2 * stiffness);
  ASSERT_EQ(run.parted.size(), 1U);
  EXPECT_EQ(run.parted[0].rope, 1);
  EXPECT_NEAR(run.parted[0].tension, weight / 2, 1e-6 * weight);
  EXPECT_NEAR(run.parted[0].energy, stored, 1e-6 * stored);
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const double tension = history.ropes[1].tension[i];
    if (history.time[i] < 1.0 - 1e-6) {
      EXPECT_NEAR(tension, weight / 2, 1e-3);
    } else if (history.time[i] > 1.0 + 1e-6) {
      EXPECT_EQ(tension, 0);
    }
  }
  // Sampled every 5e-4 s of a period of 0.14 s: within 1.3e-4 of the amplitude.
  EXPECT_NEAR(history.ropes[0].tension.maxCoeff(), 1.5 * weight, 2e-4 * weight);
  EXPECT_NEAR(history.energy.dissipated[history.sample_count() - 1], stored, 1e-6 * stored);
  EXPECT_LT(largest_imbalance(history.energy), 1e-6 * weight);  // J, as above: of a fall by a metre
}

// The error follows the tolerance, and so does the balance of energy (here with slack slings).
TEST(TimeIntegration, ErrorFollowsTheTolerance) {
  examples::SingleRopeLift model;
  model.duration = 5.0;
  const LiftSystem lift = model.build();
  const Vector3 start(3, 0, -19.9);
  const auto end = [&](double tolerance) {
    return integrate(lift, start, Vector3(0, 1, 0), {.relative_tolerance = tolerance}).q_end;
  };
  const Eigen::VectorXd reference = end(1e-12);
  const auto error = [&](double tolerance) { return (end(tolerance) - reference).norm(); };
  // The method goes to order 4 with 1e-6 and above, to order 5 below, and errs otherwise (measured:
  // 1.8e-6 m with 1e-6, 1.4e-5 m with 1e-8): each is held to the tolerance by itself.
  const double everyday = error(1e-6), fine = error(1e-8);
  EXPECT_LT(everyday, 1e-3);
  EXPECT_LT(everyday, 0.1 * error(1e-4));
  EXPECT_LT(fine, 1e-4);
  EXPECT_LT(error(1e-10), 0.1 * fine);
}

TEST(TimeIntegration, QuaternionsStayUnitAndSamplesAreConsistent) {
  const LiftSystem lift = examples::block_on_six_ropes();
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-6, .sample_interval = 0.5});
  const History& history = run.history;
  const BodyHistory& block = history.body("block");
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    EXPECT_NEAR(block.pose.row(i).tail<4>().norm(), 1.0, 1e-14);
    // Newton's law from the recorded forces and acceleration.
    Vector3 force(0, 0, -860e3 * g);
    for (const RopeHistory& rope : history.ropes) force += rope.last_force.row(i).transpose();
    EXPECT_LT((force - 860e3 * block.A_WB(i).linear).norm(), 1e-9 * 860e3 * g);
  }
  EXPECT_EQ(history.time[history.sample_count() - 1], 120.0);
}

TEST(TimeIntegration, ReportsProgressToTheEnd) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  double fraction = 0.0;
  integrate(lift, lift.q_start(), lift.v_start(), {.progress = [&](double done, double) {
              EXPECT_GE(done, fraction);
              fraction = done;
            }});
  EXPECT_NEAR(fraction, 1.0, 1e-9);
}

TEST(TimeIntegration, FailureSaysWhenWhoAndWhatToTry) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  EXPECT_THAT(
      [&] { integrate(lift, lift.q_start(), lift.v_start(), {.largest_step_count = 5}); },
      ThrowsMessage<SimulationError>(AllOf(HasSubstr("failed at t = "), HasSubstr("slack ropes"),
                                           HasSubstr("load"), HasSubstr("try gentler"))));
}

// A run that comes to its end within the steps that are allowed is not stopped for its pace; one
// that needs twice as many is.
TEST(TimeIntegration, StepsThatDoNotSufficeEndTheRun) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  const auto run = [&](long steps) {
    return integrate(lift, lift.q_start(), lift.v_start(),
                     {.relative_tolerance = 1e-10, .largest_step_count = steps})
        .statistics.steps;
  };
  const long needed = run(50'000'000);
  EXPECT_EQ(run(100 * needed), needed);
  EXPECT_THAT([&] { run(needed / 2); }, ThrowsMessage<SimulationError>(
                                            AllOf(HasSubstr("failed at t = "), HasSubstr("load"))));
}

TEST(TimeIntegration, RefusesSettingsWithoutSense) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  EXPECT_THROW(integrate(lift, lift.q_start(), lift.v_start(), {.relative_tolerance = 0.0}),
               ModelError);
  EXPECT_THROW(integrate(lift, lift.q_start(), lift.v_start(), {.sample_interval = -1.0}),
               ModelError);
}

// A load of 20 t on a line or rope of 20 m, and the same line.
struct LoadOnALine {
  explicit LoadOnALine(double damping_time) {
    model.mass = 20e3;
    model.duration = 6.0;
    model.damping_time = damping_time;
  }

  LiftSystem on_a_rope() const { return model.build(); }
  LiftSystem on_a_tugger() const {
    const LiftSystem roped = model.build();
    ForceElements elements;
    std::get<std::vector<TuggerLine>>(elements).push_back(
        TuggerLine({"line",
                    {world_index, Vector3::Zero()},
                    {1, Vector3::Zero()},
                    model.stiffness(),
                    model.damping_time * model.stiffness(),
                    model.length}));
    return LiftSystem({.mechanism = roped.mechanism(),
                       .elements = std::move(elements),
                       .operation = OperationBuilder().build(model.duration),
                       .q_start = roped.q_start()});
  }

  examples::SingleRopeLift model;
};

// A load that falls into a tugger line moves as on the rope that has its stiffness: both change at
// the same instants.
TEST(TimeIntegration, TuggerLineThatGoesSlackMovesItsLoadAsARopeDoes) {
  for (const double damping_time : {0.0, 0.005}) {
    const LoadOnALine load(damping_time);
    const Vector3 start(0, 0, 1.0 - load.model.length);
    const auto run = [&](const LiftSystem& system) {
      return integrate(system, start, Vector3::Zero(), {.relative_tolerance = 1e-8});
    };
    const IntegrationResult lined = run(load.on_a_tugger()), roped = run(load.on_a_rope());
    EXPECT_NEAR(lined.q_end[2], roped.q_end[2], 1e-8) << damping_time << " s";
    EXPECT_GE(lined.events.size(), 4u);
    ASSERT_EQ(lined.events.size(), roped.events.size());
    for (std::size_t i = 0; i < lined.events.size(); ++i) {
      EXPECT_NEAR(lined.events[i].time, roped.events[i].time, 1e-8);
      EXPECT_EQ(lined.events[i].acts, roped.events[i].acts);
    }
  }
}

// Energy of a load that falls or swings into a damped tugger line: what goes astray shrinks with
// the tolerance (measured: 2.2e-4, 2.8e-5, 2.1e-5, 5.1e-7 of the largest kinetic energy at most).
// Without the line's events it is 1.6e-3 to 4.6e-3 where the load falls, and 4.8e-5 to 2.5e-3 where
// it swings, least at 1e-7 and most at 1e-9.
TEST(TimeIntegration, EnergyOnADampedTuggerLineFollowsTheTolerance) {
  const LoadOnALine load(0.005);
  const LiftSystem lined = load.on_a_tugger();
  const auto imbalance = [&](const Vector3& start, const Vector3& velocity, double tolerance) {
    const EnergyHistory energy =
        integrate(lined, start, velocity,
                  {.relative_tolerance = tolerance, .sample_interval = 0.01})
            .history.energy;
    return largest_imbalance(energy) / energy.kinetic.maxCoeff();
  };
  const auto expect_convergence = [&](const Vector3& start, const Vector3& velocity) {
    EXPECT_LT(imbalance(start, velocity, 1e-5), 5e-4);
    EXPECT_LT(imbalance(start, velocity, 1e-6), 1e-4);
    EXPECT_LT(imbalance(start, velocity, 1e-7), 4e-5);
    EXPECT_LT(imbalance(start, velocity, 1e-9), 2e-6);
  };
  expect_convergence(Vector3(0, 0, -19), Vector3::Zero());
  expect_convergence(Vector3(3, 0, -19.5), Vector3(0, 1, 0));
}

}  // namespace
}  // namespace blocklift::dynamics
