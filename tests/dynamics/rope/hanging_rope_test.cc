#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/rope/rope.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using examples::g;

Mechanism one_load(double mass = 10e3) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3(0, 0, -g));
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = mass});
  return builder.build();
}

RopeDefinition sling() {
  return {.name = "S1",
          .points = {{world_index, Vector3::Zero()}, {1, Vector3::Zero()}},
          .axial_stiffness = 1e9,
          .damping_time = 3e-3,
          .unstretched_length = 20.0,
          .weight_per_length = 700.0};
}

/// The load's place and velocity, a rope's path and load there.
struct Hung {
  Mechanism mechanism = one_load();
  std::vector<Rope> ropes;
  Kinematics kinematics{mechanism};
  RopePath path;
  RopeLoad load;

  Hung(const RopeDefinition& definition, const Vector3& q, const Vector3& v = Vector3::Zero(),
       RopeFeed feed = {})
      : ropes{Rope(mechanism, definition)}, path(make_rope_path(ropes)) {
    compute_kinematics(mechanism, q, v, kinematics);
    ropes[0].calc_path(kinematics, path);
    if (std::isnan(feed.unstretched_length))
      feed.unstretched_length = definition.unstretched_length;
    load = ropes[0].calc_load(path, feed);
  }
  Vector3 on_world() const { return ropes[0].first_force(path, load); }
  Vector3 on_load() const { return ropes[0].last_force(path, load); }
};

// Irvine (1981), eq. 2.23 and 2.24: of the forces at the load's end follow span and drop; the rope
// must find the forces back, taut as a bar and in a bight.
TEST(HangingRope, PullsByIrvinesCatenary) {
  const double L0 = 20, w = 700, EA = 1e9, W = w * L0;
  for (const double H : {2e3, 4e4, 3e6}) {
    for (const double up : {-0.3 * W, 0.5 * W, 20 * W}) {
      // `up` pulls the load up; the world's end bears W more.
      const double V = up + W;
      const double span = H * L0 / EA + H / w * (std::asinh(V / H) - std::asinh(up / H));
      const double drop = W * L0 / EA * (V / W - 0.5) + (std::hypot(H, V) - std::hypot(H, up)) / w;
      const Hung hung(sling(), Vector3(0.6 * span, -0.8 * span, -drop));
      const Vector3 due(-0.6 * H, 0.8 * H, up);
      EXPECT_LT((hung.on_load() - due).norm(), 1e-7 * (H + std::abs(V))) << H << ' ' << up;
      EXPECT_LT((hung.on_world() + due - Vector3(0, 0, -W)).norm(), 1e-7 * (H + std::abs(V)));
      EXPECT_NEAR(hung.load.tension, std::hypot(H, std::max(V, std::abs(up))), 1e-6 * (H + V));
      EXPECT_EQ(hung.load.taut, H * span - (V + up) / 2 * -drop > W * std::hypot(span, drop));
    }
  }
}

// Plumb: the load hangs by what it weighs, the sheave bears the rope as well, and the rope of which
// each piece bears what is below it stretches by (G + W/2) L0/EA.
TEST(HangingRope, HangsPlumb) {
  const double L0 = 20, W = 14e3, EA = 1e9, G = 98.1e3;
  const Hung hung(sling(), Vector3(0, 0, -L0 - (G + W / 2) * L0 / EA));
  EXPECT_LT((hung.on_load() - Vector3(0, 0, G)).norm(), 1e-2);
  EXPECT_LT((hung.on_world() - Vector3(0, 0, -G - W)).norm(), 1e-2);
  EXPECT_NEAR(hung.load.tension, G + W, 1e-2);
  // int (G + w s)^2 / (2 EA) ds
  EXPECT_NEAR(hung.load.hanging.strain_energy, (G * G + G * W + W * W / 3) * L0 / (2 * EA), 1e-3);
  // A spring in series takes the mean.
  RopeDefinition soft = sling();
  soft.crane_stiffness = 1e7;
  const Hung series(soft, Vector3(0, 0, -L0 - (G + W / 2) * (L0 / EA + 1e-7)));
  EXPECT_LT((series.on_load() - Vector3(0, 0, G)).norm(), 1e-2);
}

// Ernst (1965): a taut chord of length l is as stiff as 1 / (L0/EA + W^2 l / (12 T^3)), W the
// weight across it. The next term is (W/T)^2 of that.
TEST(HangingRope, ItsChordIsErnstsSpring) {
  const double L0 = 60, w = 700, EA = 1e9;
  RopeDefinition definition = sling();
  definition.unstretched_length = L0;
  for (const double T : {2e5, 1e6}) {
    const double W = w * L0, chord = L0 * (1 + T / EA - W * W / (24 * T * T));
    const auto tension = [&](double longer) {
      return Hung(definition, Vector3(chord + longer, 0, 0)).load.hanging.level;
    };
    const double h = 1e-4, stiffness = (tension(h) - tension(-h)) / (2 * h);
    const double ernst = 1 / (L0 / EA + W * W * chord / (12 * T * T * T));
    EXPECT_NEAR(tension(0), T, 0.1 * T * (W / T) * (W / T));
    EXPECT_NEAR(stiffness, ernst, 2 * ernst * (W / T) * (W / T));
  }
}

// Without weight worth the name it is the rope that runs straight.
TEST(HangingRope, BecomesTheStraightRope) {
  RopeDefinition light = sling();
  light.weight_per_length = 0.1;  // 2 N of 5 MN
  light.crane_stiffness = 3e8;
  RopeDefinition straight = light;
  straight.weight_per_length = 0;
  const Vector3 q(6, 3, -18.95), v(0.1, -0.2, -0.3);
  const RopeFeed feed{19.99, 0.05};
  const Hung a(light, q, v, feed), b(straight, q, v, feed);
  ASSERT_GT(b.load.tension, 1e5);
  EXPECT_NEAR(a.load.tension, b.load.tension, 1e-6 * b.load.tension);
  EXPECT_LT((a.on_load() - b.on_load()).norm(), 1e-6 * b.load.tension);
  const EnergyAccount x = a.ropes[0].calc_energy(a.load), y = b.ropes[0].calc_energy(b.load);
  EXPECT_NEAR(x.stored_energy, y.stored_energy + 0.1 * 19.99 * (-18.95 / 2),
              1e-6 * y.stored_energy);
  EXPECT_NEAR(x.dissipated_power, y.dissipated_power, 1e-5 * y.dissipated_power);
  EXPECT_NEAR(x.supplied_power, y.supplied_power, 1e-5 * std::abs(y.supplied_power));
}

// Power on the bodies = supplied - dissipated - d(stored)/dt, the winch paying out, the spring in
// series and all.
TEST(HangingRope, EnergyAccountCloses) {
  RopeDefinition definition = sling();
  definition.crane_stiffness = 2e7;
  definition.points[1].p_BoQ_B = Vector3(0, 0, -3);
  definition.points[0].p_BoQ_B = Vector3(0, 0, -3);
  for (const Vector3& q : {Vector3(9, -4, -17), Vector3(9, -4, -17.45), Vector3(0, 0, -20.02)}) {
    const Vector3 v(0.2, 0.3, -0.4);
    const double h = 1e-5, rate = 0.17;
    const auto at = [&](double t) {
      return Hung(definition, q + t * v, v, {20.0 + t * rate, rate});
    };
    const Hung now = at(0);
    const EnergyAccount account = now.ropes[0].calc_energy(now.load);
    const auto stored = [&](double t) { return at(t).load.hanging.stored_energy; };
    const double growth = (stored(h) - stored(-h)) / (2 * h);
    const double power = now.on_load().dot(v);
    ASSERT_NEAR(now.path.first_height, -3, 1e-12);
    EXPECT_NEAR(power, account.supplied_power - account.dissipated_power - growth,
                1e-6 * (std::abs(power) + std::abs(growth)));
    EXPECT_GE(account.dissipated_power, 0);
  }
}

/// A load of 10 t on two slings, 16 m apart, and a winch on the second.
LiftSystem hanging_lift(const Vector3& start, double taken_in = 0) {
  Mechanism mechanism = one_load();
  RopeDefinition left = sling(), right = sling();
  left.points[0].p_BoQ_B = {-8, 0, 0};
  right.points[0].p_BoQ_B = {8, 1, 0};
  right.name = "S2";
  std::vector<Rope> ropes{Rope(mechanism, left), Rope(mechanism, right)};
  OperationBuilder operation;
  operation.add_winch("S2", 1, 20.0);
  if (taken_in > 0) operation.add_move("S2", {0.5, -taken_in, {0.3, 0.3, 1.0}});
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .operation = operation.build(4.0),
                     .q_start = start});
}

TEST(HangingRope, JacobianIsTheDerivative) {
  for (const Vector3& q : {Vector3(0.5, 0.2, -18.3), Vector3(1, 0.2, -17)}) {
    const LiftSystem system = hanging_lift(q);
    LiftWorkspace w(system);
    JacobianWorkspace workspace(system);
    Eigen::VectorXd y(6);
    y << q, Vector3(0.01, -0.02, 0.03);
    Eigen::MatrixXd jacobian(6, 6);
    const Contacts contacts = find_contacts(system, 0, y, w);
    calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
    const Eigen::MatrixXd differences = difference_jacobian(system, 0, y, &contacts, w, 1e-6);
    // The damping's change by the direction and the tension is left out.
    EXPECT_LT((jacobian - differences).norm(), 2e-3 * differences.norm());
  }
}

// Two slings: the supports bear load and ropes, the level forces are alike, and the moment about a
// support agrees to the weight's arm.
TEST(HangingRope, EquilibriumBearsTheRopesToo) {
  const LiftSystem system = hanging_lift({0.3, 0.4, -18});
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  LiftWorkspace& w = solver.workspace();
  Vector3 on_world = Vector3::Zero(), on_load = Vector3::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    system.ropes()[i].calc_path(w.kinematics, w.path);
    on_world += system.ropes()[i].first_force(w.path, w.rope_loads[i]);
    on_load += system.ropes()[i].last_force(w.path, w.rope_loads[i]);
  }
  EXPECT_LT((on_load - Vector3(0, 0, 10e3 * g)).norm(), 1e-3);
  EXPECT_LT((on_world + Vector3(0, 0, 10e3 * g + 2 * 14e3)).norm(), 1e-3);
}

// A load dropped from where one sling hangs in a bight, while the other's winch takes rope in: it
// snatches, and what was stored, dissipated and supplied adds up.
TEST(HangingRope, EnergyOfASnatchAddsUp) {
  const LiftSystem system = hanging_lift({0.5, 0.2, -17.6}, 0.4);
  const IntegrationResult run =
      integrate(system, system.q_start(), system.v_start(), {.relative_tolerance = 1e-8});
  const EnergyHistory& e = run.history.energy;
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd works = e.winch_work - e.dissipated;
  EXPECT_LT((energy - energy[0] - works).abs().maxCoeff(), 1e-5 * 10e3 * g);
  EXPECT_GT(e.dissipated.maxCoeff(), 1e2);
  EXPECT_GT(run.history.ropes[0].tension.maxCoeff(), 1e5);  // it was caught
}

TEST(HangingRope, EvaluatesWithoutAllocating) {
  const LiftSystem system = hanging_lift({0.5, 0.2, -18.3});
  LiftWorkspace w(system);
  Eigen::VectorXd y(6), ydot(6);
  y << 0.5, 0.2, -18.3, 0, 0, 0;
  calc_right_hand_side(system, 0, y, nullptr, w, ydot);
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not counted in this build";
  const long before = blocklift::test::allocations();
  calc_right_hand_side(system, 0, y, nullptr, w, ydot);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

TEST(HangingRope, RejectsSheavesAndNegativeWeight) {
  RopeDefinition over = sling();
  over.points.insert(over.points.begin() + 1, {world_index, {0, 0, 5}});
  EXPECT_THROW(Rope(one_load(), over), ModelError);
  RopeDefinition negative = sling();
  negative.weight_per_length = -1;
  EXPECT_THROW(Rope(one_load(), negative), ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
