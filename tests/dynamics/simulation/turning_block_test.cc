// A hook block that turns against twin falls, against the bifilar pendulum: its period, its twist
// under a moment at any angle, and its energy; a hook on a bearing with friction below it.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/linearisation.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using examples::g;

/// A block that slides without turning, what turns on it, and a hook on a bearing below.
struct TurningBlock {
  double mass = 30e3, hook_mass = 2e3;             // kg; the hook's is not in the block's
  double inertia = 24e3, hook_inertia = 500.0;     // about the vertical, kg m2
  double b = 0.6, length = 20.0, stiffness = 4e8;  // m, m, N
  double friction = 0.0, moment = 0.0;             // of the bearing, and from outside, N m
  std::string moment_on = "hook";
  double hoisted = 0.0, duration = 20.0;  // m, s
  double turn = 0.0;                      // of the block at the start, rad

  double weight() const { return (mass + hook_mass) * g; }

  LiftSystem build() const {
    MechanismBuilder builder;
    builder.set_gravity({0, 0, -g});
    builder.add_body({.name = "place", .joint = {.kind = JointKind::translational}, .mass = 0.0});
    const auto upright = [&](const char* name, const char* parent, double m, double I) {
      return builder.add_body({.name = name,
                               .parent = parent,
                               .joint = {.kind = JointKind::revolute, .axis = Vector3::UnitZ()},
                               .mass = m,
                               .I_BBcm_B = I * Matrix3::Identity()});
    };
    const BodyIndex block = upright("block", "place", mass, inertia);
    const BodyIndex hook = upright("hook", "block", hook_mass, hook_inertia);
    const Mechanism mechanism = builder.build();
    RopeDefinition tackle{.name = "tackle",
                          .points = {{world_index, {0, b, 0}},
                                     {block, {0, b, 0}},
                                     {world_index, {0, -b, 0}},
                                     {block, {0, -b, 0}}},
                          .left_out = {0, 1, 0},
                          .twin_falls = true,
                          .axial_stiffness = stiffness,
                          .unstretched_length = length};
    ForceElements elements;
    std::get<std::vector<JointFriction>>(elements).emplace_back(
        mechanism, JointFriction::Definition{
                       .name = "bearing", .body = hook, .friction = friction, .creep = 1e-4});
    std::get<std::vector<AppliedLoad>>(elements).emplace_back(
        AppliedLoad::Definition{.name = "moment",
                                .point = {mechanism.body_index(moment_on), Vector3::Zero()},
                                .moment = LoadTable(Vector3(0, 0, moment))});
    OperationBuilder operation;
    operation.add_winch("winch", 0, length);
    if (hoisted != 0.0) operation.add_move("winch", {1.0, -hoisted, {0.5, 0.2, 0.5}});
    Eigen::VectorXd q(5);
    q << 0, 0, -length * (1 + weight() / stiffness), turn, 0;
    return LiftSystem({.mechanism = mechanism,
                       .ropes = {Rope(mechanism, tackle)},
                       .elements = elements,
                       .operation = operation.build(duration),
                       .q_start = q});
  }
};

double largest_error_of_energy(const EnergyHistory& e) {
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work + e.outside_work - e.dissipated;
  return (energy - energy[0] - work).abs().maxCoeff();
}

/// Angle of the block at each sample.
Eigen::ArrayXd angles_of(const History& history, const char* body) {
  const BodyHistory& block = history.body(body);
  Eigen::ArrayXd angles(history.sample_count());
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    const Matrix3 R = block.X_WB(i).R;
    angles[i] = std::atan2(R(1, 0), R(0, 0));
  }
  return angles;
}

// omega^2 = T b^2 / (L I), L the stretched length: by linearisation, and by the zeros of a motion.
// What turns freely below does not count.
TEST(TurningBlock, SwingsAsABifilarPendulum) {
  TurningBlock block;
  const double stretched = block.length * (1 + block.weight() / block.stiffness);
  const double omega = std::sqrt(block.weight() * block.b * block.b / (stretched * block.inertia));

  const LiftSystem at_rest = block.build();
  EquilibriumSolver solver(at_rest);
  Eigen::VectorXd q = at_rest.q_start();
  solver.solve(0.0, q);
  const Linearisation modes = linearise(at_rest, 0.0, solver.workspace());
  double nearest = 0;
  for (const Mode& mode : modes.modes)
    if (std::abs(mode.natural_frequency() - omega) < std::abs(nearest - omega))
      nearest = mode.natural_frequency();
  EXPECT_NEAR(nearest / omega, 1.0, 1e-8);

  block.turn = 0.02;
  block.duration = 3.2 * 2 * std::numbers::pi / omega;
  const LiftSystem system = block.build();
  const IntegrationResult run = integrate(system, system.q_start(), system.v_start(),
                                          {.relative_tolerance = 1e-10, .sample_interval = 0.01});
  const Eigen::ArrayXd angle = angles_of(run.history, "block");
  std::vector<double> zeros;
  for (Eigen::Index i = 1; i < angle.size(); ++i)
    if (angle[i - 1] * angle[i] < 0)
      zeros.push_back(run.history.time[i - 1] + 0.01 * angle[i - 1] / (angle[i - 1] - angle[i]));
  ASSERT_GE(zeros.size(), 6U);
  // The height changes by the fourth power of the amplitude; its square adds a sixteenth to the
  // period: 2.5e-5.
  const double period = (zeros[5] - zeros[1]) / 2;
  EXPECT_NEAR(period * omega / (2 * std::numbers::pi), 1.0, 5e-5);
  EXPECT_LT(angles_of(run.history, "hook").abs().maxCoeff(), 0.02 + 1e-9);
}

// From statics, M = W b^2 sin(theta) / h at any angle, with the height h^2 = L^2 - 2 b^2 (1 -
// cos(theta)) and falls of the length L = L0 (1 + T / EA), T = W L / h.
TEST(TurningBlock, TwistsUnderAMomentAsByHand) {
  for (const double theta : {0.05, 0.7, 1.4}) {
    TurningBlock block;
    block.b = 1.5;
    block.length = 6.0;
    const double b2 = block.b * block.b, W = block.weight();
    double L = block.length, h = L;
    for (int i = 0; i < 60; ++i) {
      h = std::sqrt(L * L - 2 * b2 * (1 - std::cos(theta)));
      L = block.length * (1 + W * L / h / block.stiffness);
    }
    block.moment = W * b2 * std::sin(theta) / h;
    block.moment_on = "block";  // a hook that turns freely would turn for ever
    block.turn = 0.6 * theta;
    const LiftSystem system = block.build();
    EquilibriumSolver solver(system);
    Eigen::VectorXd q = system.q_start();
    solver.solve(0.0, q);
    EXPECT_NEAR(q[3], theta, 1e-7);
    EXPECT_NEAR(q[2], -h, 1e-8);
    EXPECT_NEAR(solver.workspace().rope_loads[0].tension, W * L / h, 1e-6 * W);
  }
}

// Large swings, up to 100 degrees, while the winch hoists: the account of energy holds.
TEST(TurningBlock, AccountsForItsEnergy) {
  TurningBlock block;
  block.b = 1.5;
  block.length = 8.0;
  block.hoisted = 3.0;
  block.turn = 1.75;
  const LiftSystem system = block.build();
  const IntegrationResult run =
      integrate(system, system.q_start(), system.v_start(), {.relative_tolerance = 1e-10});
  EXPECT_GT(angles_of(run.history, "block").maxCoeff(), 1.7);
  EXPECT_LT(angles_of(run.history, "block").minCoeff(), -1.0);
  EXPECT_LT(largest_error_of_energy(run.history.energy), 1e-6 * block.weight() * block.hoisted);
}

// A moment on the hook beyond the bearing's friction turns the hook by what is beyond it, and the
// block by the friction, about M_f L / (T b^2); one below it turns both together.
TEST(TurningBlock, HookTurnsOnItsBearingBeyondTheFriction) {
  TurningBlock block;
  block.friction = 300;
  block.moment = 320;
  block.duration = 12;
  const LiftSystem system = block.build();
  const IntegrationResult run =
      integrate(system, system.q_start(), system.v_start(), {.relative_tolerance = 1e-9});
  const auto turn_rate = [&](const char* body) -> double {
    return run.history.body(body).velocity(run.history.sample_count() - 1, 2);
  };
  // d(I omega)/dt = M - M_f, from the start on but for the creep.
  EXPECT_NEAR(turn_rate("hook"), (320 - 300) * 12 / block.hook_inertia, 1e-3);
  const double twist = 300 * block.length / (block.weight() * block.b * block.b);
  EXPECT_NEAR(angles_of(run.history, "block").maxCoeff(), 2 * twist, 0.02 * twist);
  // Over the angle (M - M_f) t^2 / (2 I) less that of the block.
  EXPECT_NEAR(run.history.energy.dissipated.tail<1>()[0], 300 * 2.88, 300 * 2 * twist);
  EXPECT_LT(largest_error_of_energy(run.history.energy), 0.1);

  block.moment = 100;
  const LiftSystem held = block.build();
  const IntegrationResult together =
      integrate(held, held.q_start(), held.v_start(), {.relative_tolerance = 1e-9});
  const Eigen::ArrayXd apart =
      angles_of(together.history, "hook") - angles_of(together.history, "block");
  // Creep at v0 artanh(100 / 300), a little more while the block turns: 12 s of 0.35e-4 rad/s.
  EXPECT_LT(apart.abs().maxCoeff(), 1e-3);
  EXPECT_NEAR(angles_of(together.history, "block").maxCoeff(), 2 * twist / 3, 0.02 * twist);
}

TEST(TurningBlock, RightHandSideAllocatesNothing) {
  using blocklift::test::allocations;
  if (!blocklift::test::counts_allocations())
    GTEST_SKIP() << "allocations cannot be counted in this build";
  TurningBlock block;
  block.friction = 300;
  block.turn = 0.4;
  const LiftSystem system = block.build();
  LiftWorkspace w(system);
  Eigen::VectorXd y(system.state_size()), ydot(system.state_size());
  get_state(system, system.q_start(), system.v_start(), y);
  const Contacts contacts = find_contacts(system, 0.0, y, w);
  const long before = allocations();
  for (int i = 0; i < 100; ++i) calc_right_hand_side(system, 0.1 * i, y, &contacts, w, ydot);
  EXPECT_EQ(allocations(), before);
  EXPECT_TRUE(ydot.allFinite());
}

}  // namespace
}  // namespace blocklift::dynamics
