#include "dynamics/rope/rope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Mechanism single_load() {
  MechanismBuilder builder;
  builder.add_body({.name = "load", .joint = {.kind = JointKind::translational}, .mass = 1.0});
  return builder.build();
}

RopeDefinition simple_rope() {
  return {.name = "H1",
          .points = {{world_index, Vector3::Zero()}, {1, Vector3::Zero()}},
          .axial_stiffness = 6e6,
          .unstretched_length = 3.0};
}

// A right triangle 3-4-5 and a vertical part: from the world over a sheave on the world to the
// load.
TEST(Rope, PathOverASheaveByHand) {
  const Mechanism mechanism = single_load();
  RopeDefinition definition = simple_rope();
  definition.points = {{world_index, {0, 0, 0}}, {world_index, {3, 0, 4}}, {1, {0, 0, 0}}};
  const std::vector<Rope> ropes{Rope(mechanism, definition)};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(mechanism);
  compute_kinematics(mechanism, Vector3(3, 12, -1), Vector3(7, 12, -5), kinematics);
  ropes[0].calc_path(kinematics, path);
  EXPECT_NEAR(path.length, 5.0 + 13.0, 1e-14);
  // The load is (0, 12, -5) from the sheave: the rate is (0, 12, -5)/13 . (7, 12, -5) = 13.
  EXPECT_NEAR(path.length_rate, 13.0, 1e-14);

  std::vector<ForceVector> F(2, ForceVector::zero());
  ropes[0].add_forces(path, 26.0, F);
  EXPECT_LT((F[1].force - Vector3(0, -24, 10)).norm(), 1e-13);
  // The winch's end and the sheave belong to one body: what is left is the pull towards the load.
  EXPECT_LT((F[0].force - Vector3(0, 24, -10)).norm(), 1e-13);
  EXPECT_LT((ropes[0].last_force(path, 26.0) - Vector3(0, -24, 10)).norm(), 1e-13);
  EXPECT_LT((ropes[0].first_force(path, 26.0) - Vector3(15.6, 0, 20.8)).norm(), 1e-13);
}

// SIMO theory manual, simple wire coupling: 1/k = L/EA + 1/k0.
TEST(Rope, CraneStiffnessActsInSeries) {
  RopeDefinition definition = simple_rope();
  EXPECT_DOUBLE_EQ(Rope(single_load(), definition).stiffness(3.0), 2e6);
  definition.crane_stiffness = 2e6;
  EXPECT_DOUBLE_EQ(Rope(single_load(), definition).stiffness(3.0), 1e6);
}

TEST(Rope, PullsButNeverPushes) {
  RopeDefinition definition = simple_rope();
  definition.damping_time = 0.01;
  const Rope rope(single_load(), definition);
  RopePath path;
  const auto tension = [&](double elongation, double rate) {
    path.length = 3.0 + elongation;
    path.length_rate = rate;
    return rope.calc_load(path, {3.0, 0.0}).tension;
  };
  EXPECT_NEAR(tension(0.1, 0.0), 2e5, 1e-6);
  EXPECT_NEAR(tension(0.1, 1.0), 2e5 + 2e4, 1e-6);
  EXPECT_EQ(tension(0.1, -20.0), 0.0);  // damping would push
  EXPECT_EQ(tension(-0.1, 0.0), 0.0);
  EXPECT_EQ(tension(-0.1, 20.0), 0.0);  // slack: no damping either
}

// One rope reeved through two tackles: the part between the upper sheaves counts for nothing, and
// both hooks are pulled alike.
TEST(Rope, LeavesSegmentsOut) {
  MechanismBuilder builder;
  builder.add_body({.name = "left", .joint = {.kind = JointKind::translational}, .mass = 1.0});
  builder.add_body({.name = "right", .joint = {.kind = JointKind::translational}, .mass = 1.0});
  const Mechanism mechanism = builder.build();
  RopeDefinition definition = simple_rope();
  definition.points = {{1, Vector3::Zero()},
                       {world_index, {-6, 0, 20}},
                       {world_index, {6, 0, 20}},
                       {2, Vector3::Zero()}};
  definition.left_out = {0, 1, 0};
  const std::vector<Rope> ropes{Rope(mechanism, definition)};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(mechanism);
  Eigen::VectorXd q(6), v(6);
  q << -6, 0, 5, 6, 0, 8;
  v << 0, 0, -1, 0, 0, 0.25;
  compute_kinematics(mechanism, q, v, kinematics);
  ropes[0].calc_path(kinematics, path);
  EXPECT_DOUBLE_EQ(path.length, 15.0 + 12.0);
  EXPECT_DOUBLE_EQ(path.length_rate, 1.0 - 0.25);
  std::vector<ForceVector> F(3, ForceVector::zero());
  ropes[0].add_forces(path, 7.0, F);
  EXPECT_LT((F[1].force - Vector3(0, 0, 7)).norm(), 1e-14);
  EXPECT_LT((F[2].force - Vector3(0, 0, 7)).norm(), 1e-14);
  EXPECT_LT((ropes[0].first_force(path, 7.0) - Vector3(0, 0, 7)).norm(), 1e-14);
  EXPECT_LT((ropes[0].last_force(path, 7.0) - Vector3(0, 0, 7)).norm(), 1e-14);
}

// Two plumb falls 2 b apart, the block below turned by theta: with L their length by then, the
// tension T turns it back by T b^2 sin(theta) / L and lifts with T h / L, where L^2 = h^2 +
// 2 b^2 (1 - cos(theta)).
TEST(Rope, TwinFallsTurnBackWhatTurns) {
  MechanismBuilder builder;
  builder.add_body({.name = "place", .joint = {.kind = JointKind::translational}, .mass = 0.0});
  builder.add_body({.name = "block",
                    .parent = "place",
                    .joint = {.kind = JointKind::revolute, .axis = Vector3::UnitZ()},
                    .mass = 1.0,
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const double b = 0.6, h = 5.0, theta = 0.8, T = 9.0;
  RopeDefinition definition = simple_rope();
  definition.points = {
      {world_index, {0, b, h}}, {2, {0, b, 0}}, {world_index, {0, -b, h}}, {2, {0, -b, 0}}};
  definition.left_out = {0, 1, 0};
  definition.twin_falls = true;
  const std::vector<Rope> ropes{Rope(mechanism, definition)};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(mechanism);
  const Vector4 q(0, 0, 0, theta), v(0, 0, 0, 0.3);
  compute_kinematics(mechanism, q, v, kinematics);
  ropes[0].calc_path(kinematics, path);
  const double L = std::sqrt(h * h + 2 * b * b * (1 - std::cos(theta)));
  const double moment = T * b * b * std::sin(theta) / L;
  EXPECT_NEAR(path.length, L, 1e-14);
  EXPECT_NEAR(path.length_rate, moment / T * 0.3, 1e-15);
  std::vector<ForceVector> F(3, ForceVector::zero());
  ropes[0].add_forces(path, T, F);
  EXPECT_LT((F[2].moment - Vector3(0, 0, -moment)).norm(), 1e-14);
  const Vector3 lift(0, 0, T * h / L);
  EXPECT_LT((F[2].force - lift).norm(), 1e-14);
  EXPECT_LT((ropes[0].last_force(path, T) - lift).norm(), 1e-14);
  EXPECT_LT((ropes[0].first_force(path, T) + lift).norm(), 1e-14);

  definition.left_out = {0, 0, 0};
  EXPECT_THAT([&] { Rope(mechanism, definition); }, ThrowsMessage<ModelError>(HasSubstr("twin")));
}

// Random mechanisms, paths and motions: power of the point forces = -T dL/dt, and dL/dt is the
// derivative of L.
TEST(Rope, SpendsThePowerOfItsPointForces) {
  examples::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Mechanism mechanism = examples::random_tree(random, 6, true);
    const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
    const Eigen::VectorXd v = random.values(mechanism.nv(), 1);
    RopeDefinition definition = simple_rope();
    definition.points.clear();
    for (int i = 0; i < 4; ++i) {
      definition.points.push_back({(trial + 2 * i) % mechanism.body_count(), random.vector(2)});
    }
    if (trial % 3 > 0) definition.left_out = {0, 1, 0};
    definition.twin_falls = trial % 3 == 2;
    const std::vector<Rope> ropes{Rope(mechanism, definition)};
    RopePath path = make_rope_path(ropes);
    Kinematics kinematics(mechanism);
    std::vector<ForceVector> F(kinematics.V_WB.size(), ForceVector::zero());
    compute_kinematics(mechanism, q, v, kinematics);
    ropes[0].calc_path(kinematics, path);
    ropes[0].add_forces(path, 3.0, F);
    double power = 0.0;
    for (std::size_t i = 0; i < F.size(); ++i) power += dot(F[i], kinematics.V_WB[i]);
    const double rate = path.length_rate;
    EXPECT_NEAR(power, -3.0 * rate, 1e-12 * (1.0 + std::abs(rate)));

    constexpr double h = 1e-5;  // central difference: error h^2 times the third derivative
    Eigen::VectorXd moved(mechanism.nq());
    std::array<double, 2> lengths{};
    for (int side = 0; side < 2; ++side) {
      mechanism.integrate(q, v, side == 0 ? -h : h, moved);
      compute_kinematics(mechanism, moved, v, kinematics);
      ropes[0].calc_path(kinematics, path);
      lengths[side] = path.length;
    }
    EXPECT_NEAR((lengths[1] - lengths[0]) / (2 * h), rate, 1e-6 * (1.0 + std::abs(rate)));
  }
}

// power on bodies = supplied - dissipated - d(stored)/dt with the winch running.
TEST(Rope, AccountsForItsEnergy) {
  RopeDefinition definition = simple_rope();
  definition.crane_stiffness = 5e6;
  definition.damping_time = 0.02;
  definition.damping = 1e3;
  const Rope rope(single_load(), definition);
  const auto load_at = [&](double t) {
    RopePath path;
    path.length = 3.2 + 0.7 * t;
    path.length_rate = 0.7;
    return rope.calc_load(path, {3.0 - 0.4 * t, -0.4});
  };
  constexpr double h = 1e-6;
  const double stored_rate =
      (rope.calc_energy(load_at(h)).stored_energy - rope.calc_energy(load_at(-h)).stored_energy) /
      (2 * h);
  const RopeLoad load = load_at(0.0);
  const EnergyAccount account = rope.calc_energy(load);
  EXPECT_GT(account.dissipated_power, 0.0);
  EXPECT_GT(account.supplied_power, 0.0);
  EXPECT_NEAR(-load.tension * load.length_rate,
              account.supplied_power - account.dissipated_power - stored_rate,
              1e-8 * account.supplied_power);
}

TEST(Rope, RefusesWhatCannotBe) {
  const Mechanism mechanism = single_load();
  const auto refusal = [&](auto&& change) {
    RopeDefinition definition = simple_rope();
    change(definition);
    try {
      Rope rope(mechanism, definition);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal([](auto& d) { d.points.pop_back(); }), HasSubstr("1 point(s)"));
  EXPECT_THAT(refusal([](auto& d) { d.points[0].body = 1; }), HasSubstr("same point of \"load\""));
  EXPECT_THAT(refusal([](auto& d) { d.axial_stiffness = 0; }), HasSubstr("axial stiffness"));
  EXPECT_THAT(refusal([](auto& d) { d.crane_stiffness = -1; }), HasSubstr("crane stiffness"));
  EXPECT_THAT(refusal([](auto& d) { d.damping_time = -1; }), HasSubstr("damping time"));
  EXPECT_THAT(refusal([](auto& d) { d.unstretched_length = 0; }), HasSubstr("unstretched length"));
  EXPECT_THAT(refusal([](auto& d) { d.left_out = {1}; }), HasSubstr("left out"));
  EXPECT_THAT(refusal([](auto& d) { d.left_out = {0, 0}; }), HasSubstr("left out"));
  const TensionLaw law({{0, 0}, {0.01, 1e5}});
  EXPECT_THAT(refusal([&](auto& d) { d.tension_law = law; }), HasSubstr("an axial stiffness"));
  EXPECT_THAT(refusal([&](auto& d) {
                d.tension_law = law;
                d.axial_stiffness = not_a_number;
                d.weight_per_length = 10.0;
              }),
              HasSubstr("catenary"));
  EXPECT_THAT(refusal([](auto&) {}), HasSubstr("accepted"));
}

TEST(Rope, NamesItselfWhereItsPullHasNoDirection) {
  const Mechanism mechanism = single_load();
  const std::vector<Rope> ropes{Rope(mechanism, simple_rope())};
  RopePath path = make_rope_path(ropes);
  Kinematics kinematics(mechanism);
  compute_kinematics(mechanism, Vector3::Zero(), Vector3::Zero(), kinematics);
  EXPECT_THAT([&] { ropes[0].calc_path(kinematics, path); },
              ThrowsMessage<ModelError>(HasSubstr("rope \"H1\"")));
}

}  // namespace
}  // namespace blocklift::dynamics
