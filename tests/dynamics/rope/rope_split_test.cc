// Friction between a rope and its sheaves: Euler (1769) and Eytelwein (1808), two weights over a
// sheave in closed form, the shares of standards, energy, events.
#include "dynamics/rope/rope_split.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
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

// Friction by which parallel parts of a rope carry that share, and the rest of 100 %.
double friction_for_share(double larger) { return std::log(larger / (1.0 - larger)) / pi; }

// Two weights on one rope over a fixed sheave at the origin, in line below it: wrapped by 180
// degrees. Or over two, with a level part between them.
struct TwoWeights {
  double first_mass = 10e3, last_mass = 10e3;  // kg
  double friction = 0.1;
  double damping_time = 0.0;
  double axial_stiffness = 40e6;  // N
  double duration = 4.0;          // s
  double between_sheaves = 0.0;   // m
  double payout = 0.0;            // m

  double first_length = 20.0, last_length = 20.0;  // m, unstretched

  LiftSystem build() const {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -standard_gravity});
    for (const char* name : {"first", "last"}) {
      builder.add_body({.name = name,
                        .joint = {.kind = JointKind::translational},
                        .mass = name[0] == 'f' ? first_mass : last_mass});
    }
    Mechanism mechanism = builder.build();
    RopeDefinition rope{.name = "rope",
                        .points = {{1, Vector3::Zero()}, {world_index, Vector3::Zero()}},
                        .axial_stiffness = axial_stiffness,
                        .damping_time = damping_time,
                        .unstretched_length = first_length + between_sheaves + last_length,
                        .sheave_friction = friction};
    if (between_sheaves > 0.0) rope.points.push_back({world_index, {between_sheaves, 0, 0}});
    rope.points.push_back({2, Vector3::Zero()});
    OperationBuilder operation;
    operation.add_winch("winch", 0, rope.unstretched_length);
    if (payout != 0.0) operation.add_move("winch", {0.5, payout, {0.5, 1.0, 5.0}});
    const Operation built = operation.build(duration);
    std::vector<Rope> ropes;
    ropes.emplace_back(mechanism, rope);
    return LiftSystem({.mechanism = std::move(mechanism),
                       .ropes = std::move(ropes),
                       .operation = built,
                       .q_start = hang(0.0)});
  }
  // Both weights as if the rope bore this everywhere, N.
  Eigen::VectorXd hang(double tension) const {
    const double stretch = 1.0 + tension / axial_stiffness;
    Eigen::VectorXd q(6);
    q << 0, 0, -first_length * stretch - tension * between_sheaves / axial_stiffness,
        between_sheaves, 0, -last_length * stretch;
    return q;
  }
};

Eigen::VectorXd speeds(double first, double last) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  v[2] = first;
  v[5] = last;
  return v;
}

struct Tensions {
  Eigen::ArrayXd first, last;
};
Tensions tensions(const IntegrationResult& run) {
  const RopeHistory& rope = run.history.ropes[0];
  return {rope.first_force.rowwise().norm(), rope.last_force.rowwise().norm()};
}

// A path of 3-4-5 and 5-12-13 triangles, the angle of its turn, and tensions by hand.
TEST(RopeSplit, DividesByHand) {
  MechanismBuilder builder;
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = 1.0});
  const Mechanism mechanism = builder.build();
  const std::vector<Rope> ropes{Rope(
      mechanism, {.name = "rope",
                  .points = {{world_index, {0, 0, 0}}, {world_index, {3, 0, 4}}, {1, {0, 0, 0}}},
                  .axial_stiffness = 6e6,
                  .unstretched_length = 17.9,
                  .sheave_friction = 0.2})};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(mechanism);
  RopeSplit split(ropes[0]);
  EXPECT_TRUE(split.rubs());
  EXPECT_FALSE(split.acts());
  const auto divide = [&](const Vector3& q, const Vector3& v) {
    compute_kinematics(mechanism, q, v, kinematics);
    ropes[0].calc_path(kinematics, path);
    RopeLoad load = ropes[0].calc_load(path, {17.9, 0.0});
    if (!split.acts()) split.begin(ropes[0], kinematics, path, load);
    split.divide(ropes[0], kinematics, path, load);
    return load;
  };
  // At first one tension: 0.1 m of stretch over 17.9 m.
  RopeLoad load = divide({3, 12, -1}, {0, 0, 0});
  const double even = 6e6 * 0.1 / 17.9;
  EXPECT_NEAR(split.tension(0), even, 1e-6);
  EXPECT_NEAR(split.tension(1), even, 1e-6);
  // cos(theta) = (3, 0, 4)/5 . (0, 12, -5)/13
  EXPECT_NEAR(split.wrap(0), std::acos(-20.0 / 65.0), 1e-14);
  EXPECT_GT(split.indicator(0), 0.0);
  // A little further: what is beyond the sheave stretches alone.
  const double l = split.unstretched_length(1);
  load = divide({3, 12.001, -1.0}, {0, 0, 0});
  EXPECT_NEAR(split.tension(0), even, 1e-6);
  EXPECT_NEAR(split.tension(1), 6e6 * (std::hypot(12.001, 5.0) / l - 1.0), 1e-6);
  EXPECT_EQ(load.tension, split.tension(1));
  // Slipping, the ratio is that of the wrap, and what leaves one side is on the other.
  ASSERT_EQ(split.tendency(0), BendMotion::to_last);
  split.set_motion(0, BendMotion::to_last);
  load = divide({3, 12.1, -1.0}, {0, 1, 0});
  EXPECT_NEAR(split.tension(1) / split.tension(0), std::exp(0.2 * split.wrap(0)), 1e-12);
  EXPECT_NEAR(split.unstretched_length(0) + split.unstretched_length(1), 17.9, 1e-12);
  // Its rate by differences: the wrap changes, too.
  const double rate = split.slip_rate(0);
  divide({3, 12.1 + 1e-5, -1.0}, {0, 1, 0});
  const double ahead = split.unstretched_length(1);
  divide({3, 12.1 - 1e-5, -1.0}, {0, 1, 0});
  EXPECT_NEAR((ahead - split.unstretched_length(1)) / 2e-5, rate, 1e-8);
  EXPECT_GT(split.indicator(0), 0.0);
}

// Weights whose ratio lies within the cone hang still, each on its own side: T = m g.
TEST(RopeSplit, SticksWithinTheCone) {
  TwoWeights model{.first_mass = 10e3, .last_mass = 11e3, .damping_time = 0.05};
  model.duration = 10.0;
  const LiftSystem lift = model.build();
  const IntegrationResult run = integrate(lift, model.hang(10.5e3 * standard_gravity),
                                          lift.v_start(), {.relative_tolerance = 1e-9});
  EXPECT_EQ(run.statistics.bend_changes, 0);
  const auto [first, last] = tensions(run);
  EXPECT_NEAR(first.tail(1)[0] / (model.first_mass * standard_gravity), 1.0, 1e-6);
  EXPECT_NEAR(last.tail(1)[0] / (model.last_mass * standard_gravity), 1.0, 1e-6);
  EXPECT_DOUBLE_EQ(run.history.ropes[0].tension.tail(1)[0], last.tail(1)[0]);
  EXPECT_LT(run.v_end.norm(), 1e-6);
}

// GL Noble Denton 0027/ND, rev. 11.2: a greased sheave shares 49:51, a two-part sling 45:55, one
// over a trunnion in upending 32.5:67.5. Weights apart by far more move like on Atwood's machine:
//   a = g (m_b - e m_a) / (m_b + e m_a),   T_b = e T_a.
TEST(RopeSplit, SlipsAtTheSharesOfStandards) {
  for (const double share : {0.51, 0.55, 0.675}) {
    TwoWeights model{.first_mass = 5e3, .last_mass = 20e3, .damping_time = 0.02};
    model.friction = friction_for_share(share);
    model.axial_stiffness = 400e6;
    model.first_length = model.last_length = 40.0;
    model.duration = 1.5;
    const LiftSystem lift = model.build();
    const double ratio = share / (1.0 - share);
    const double a = standard_gravity * (model.last_mass - ratio * model.first_mass) /
                     (model.last_mass + ratio * model.first_mass);
    const IntegrationResult run =
        integrate(lift, model.hang(model.first_mass * (standard_gravity + a)), lift.v_start(),
                  {.relative_tolerance = 1e-9, .sample_interval = 0.01});
    ASSERT_GE(run.statistics.bend_changes, 1);
    const auto [first, last] = tensions(run);
    for (Eigen::Index i = 100; i < first.size(); ++i) {
      EXPECT_NEAR(last[i] / (first[i] + last[i]), share, 1e-9) << run.history.time[i];
    }
    // A stretched rope moves otherwise by its strain of 3e-4, and rings a little longer.
    const auto velocity = run.history.bodies[1].velocity.col(5);
    EXPECT_NEAR((velocity[150] - velocity[100]) / 0.5, -a, 3e-3 * a);
    const EnergyHistory& energy = run.history.energy;
    EXPECT_LT(imbalance_of(energy), 1e-6 * energy.kinetic.maxCoeff());
    EXPECT_GT(energy.dissipated.tail(1)[0], 0.0);
  }
}

// Equal weights set going slow down by the friction alone, stop after v (e + 1) / (g (e - 1)) and
// half of that times v, and stick. (The rope sticks for a first millisecond, until the ratio is
// reached; in it damping c v takes 2 c v^2 0.5 mm / v, 0.8 % of what they have.)
TEST(RopeSplit, ComesToAStandAndSticks) {
  constexpr double v = 0.5;
  TwoWeights model{.friction = friction_for_share(0.55), .damping_time = 0.002};
  model.axial_stiffness = 400e6;
  model.duration = 3.0;
  const LiftSystem lift = model.build();
  const double braking = standard_gravity * (0.55 - 0.45);
  const double weight = model.first_mass * standard_gravity;
  const IntegrationResult run = integrate(lift, model.hang(weight), speeds(v, -v),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.01});
  const double travel = 0.5 * v * v / braking;
  EXPECT_NEAR(run.q_end[2] - model.hang(weight)[2], travel, 0.02 * travel);
  EXPECT_LT(run.v_end.norm(), 1e-3 * v);
  EXPECT_GE(run.statistics.bend_changes, 2);
  EXPECT_LT(run.statistics.bend_changes, 60);
  // All of what they had is friction's in the end, but for a bounce.
  const EnergyHistory& energy = run.history.energy;
  EXPECT_LT(imbalance_of(energy), 1e-6 * weight);
  EXPECT_NEAR(energy.dissipated.tail(1)[0] / energy.kinetic[0], 1.0, 0.01);
  EXPECT_TRUE(
      (energy.dissipated.tail(299).array() >= energy.dissipated.head(299).array() - 1e-6).all());
}

// Over two sheaves with a quarter turn each the ratio is that of a half turn, whichever way, while
// a winch pays out at the first end.
TEST(RopeSplit, SheavesMultiply) {
  for (const bool to_first : {false, true}) {
    TwoWeights model{.first_mass = 5e3, .last_mass = 20e3, .friction = 0.1, .damping_time = 0.02};
    model.between_sheaves = 6.0;
    model.payout = 0.2;
    model.duration = 2.0;
    if (to_first) std::swap(model.first_mass, model.last_mass);
    const LiftSystem lift = model.build();
    const IntegrationResult run =
        integrate(lift, model.hang(7e3 * standard_gravity), lift.v_start(),
                  {.relative_tolerance = 1e-9, .sample_interval = 0.01});
    const auto [first, last] = tensions(run);
    const double ratio =
        to_first ? first.tail(1)[0] / last.tail(1)[0] : last.tail(1)[0] / first.tail(1)[0];
    EXPECT_NEAR(ratio, std::exp(0.1 * pi), 1e-9);
    EXPECT_LT(imbalance_of(run.history.energy), 1e-5 * 20e3 * standard_gravity);
  }
}

// Thrown up: slack and taut again, slipping and sticking.
TEST(RopeSplit, EnergyClosesOverSlackSlipAndStick) {
  TwoWeights model{.first_mass = 10e3, .last_mass = 10.5e3, .friction = 0.05};
  const LiftSystem lift = model.build();
  const IntegrationResult run =
      integrate(lift, model.hang(10e3 * standard_gravity), speeds(1.5, 1.0),
                {.relative_tolerance = 1e-9, .sample_interval = 0.01});
  EXPECT_GE(run.statistics.contact_changes, 2);
  EXPECT_GE(run.statistics.bend_changes, 2);
  EXPECT_LT(imbalance_of(run.history.energy), 1e-5 * 10e3 * standard_gravity);
  const auto [first, last] = tensions(run);
  const double capstan = std::exp(0.05 * pi);
  EXPECT_TRUE((first <= capstan * last * (1.0 + 1e-6) + 10.0).all());
  EXPECT_TRUE((last <= capstan * first * (1.0 + 1e-6) + 10.0).all());
}

// Hardly any friction is none: the same motion, with one tension all along.
TEST(RopeSplit, VanishesWithTheFriction) {
  TwoWeights model{.first_mass = 5e3, .last_mass = 20e3, .friction = 1e-8};
  model.duration = 1.0;
  const LiftSystem rubbing = model.build();
  model.friction = 0.0;
  const LiftSystem smooth = model.build();
  const auto run = [&](const LiftSystem& lift) {
    return integrate(lift, model.hang(8e3 * standard_gravity), lift.v_start(),
                     {.relative_tolerance = 1e-10});
  };
  const IntegrationResult with = run(rubbing), without = run(smooth);
  EXPECT_LT((with.q_end - without.q_end).norm(), 1e-6);
  EXPECT_LT(
      (with.history.ropes[0].tension - without.history.ropes[0].tension).cwiseAbs().maxCoeff(),
      1e-5 * 8e3 * standard_gravity);
  const auto [first, last] = tensions(without);
  EXPECT_TRUE((first == last).all());
  EXPECT_EQ(without.statistics.bend_changes, 0);
}

// A run that goes on from an instant at which the rope slips goes on as it did.
TEST(RopeSplit, GoesOnFromAnInstant) {
  TwoWeights model{.friction = friction_for_share(0.55), .damping_time = 0.02};
  model.duration = 3.0;
  const LiftSystem lift = model.build();
  const Eigen::VectorXd start = model.hang(model.first_mass * standard_gravity);
  std::optional<Departure> departure;
  IntegrationSettings settings{.relative_tolerance = 1e-10};
  settings.observe = [&](Eigen::Index, double time, const LiftWorkspace& w) {
    if (std::abs(time - 0.25) < 1e-9) departure = Departure::of(time, w);
  };
  const IntegrationResult whole = integrate(lift, start, speeds(0.5, -0.5), settings);
  ASSERT_TRUE(departure);
  settings.observe = {};
  settings.departure = &*departure;
  const IntegrationResult rest = integrate(lift, start, speeds(0.5, -0.5), settings);
  EXPECT_LT((whole.q_end - rest.q_end).norm(), 1e-5);
}

TEST(RopeSplit, AllocatesNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not counted in this build";
  TwoWeights model{.first_mass = 5e3, .last_mass = 20e3, .friction = 0.05};
  const LiftSystem lift = model.build();
  LiftWorkspace w(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, model.hang(8e3 * standard_gravity), lift.v_start(), y);
  const Contacts contacts = find_contacts(lift, 0.0, y, w);
  calc_contact_loads(lift, &contacts, w);
  lift.ropes()[0].calc_path(w.kinematics, w.path);
  w.splits[0].begin(lift.ropes()[0], w.kinematics, w.path, w.rope_loads[0]);
  calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
  for (const BendMotion motion : {BendMotion::sticks, BendMotion::to_last}) {
    w.splits[0].set_motion(0, motion);
    const long before = blocklift::test::allocations();
    double sum = 0.0;
    for (int i = 0; i < 10; ++i) {
      calc_right_hand_side(lift, 0.0, y, &contacts, w, ydot);
      sum += w.splits[0].indicator(0) + calc_energy_rates(lift, 0.0, w).dissipated_power;
    }
    EXPECT_EQ(blocklift::test::allocations(), before);
    EXPECT_TRUE(std::isfinite(sum));
  }
}

TEST(RopeSplit, JacobianIsThatOfTheForces) {
  TwoWeights model{.first_mass = 5e3, .last_mass = 20e3, .friction = 0.05, .damping_time = 0.01};
  model.between_sheaves = 6.0;
  const LiftSystem lift = model.build();
  Eigen::VectorXd q = model.hang(8e3 * standard_gravity);
  q[0] += 3.0;
  q[4] += 4.0;
  Eigen::VectorXd v = speeds(0.1, -0.2);
  v[1] = 0.3;
  test::expect_jacobian_of_split(lift, q, v);
}

TEST(RopeSplit, RefusesWhatHasNoMeaning) {
  EXPECT_THAT([] { TwoWeights{.friction = -0.1}.build(); },
              ThrowsMessage<ModelError>(HasSubstr("sheave friction")));
  MechanismBuilder builder;
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = 1.0});
  const Mechanism mechanism = builder.build();
  EXPECT_THAT(
      [&] {
        Rope(mechanism, {.name = "R1",
                         .points = {{world_index, Vector3::Zero()}, {1, Vector3::Zero()}},
                         .axial_stiffness = 1e6,
                         .unstretched_length = 3.0,
                         .sheave_friction = 0.1});
      },
      ThrowsMessage<ModelError>(HasSubstr("rope \"R1\" has friction at its sheaves")));
}

}  // namespace
}  // namespace blocklift::dynamics
