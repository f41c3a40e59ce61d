#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/force/joint_friction.h"
#include "dynamics/force/spring.h"
#include "dynamics/force/support.h"
#include "dynamics/force/torsional_spring.h"
#include "dynamics/force/wind.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using test::expect_balanced;
using test::OneBody;

TEST(PointSpring, PullsAndPushesAndBalances) {
  OneBody body;
  const PointSpring spring({.name = "s",
                            .from = {world_index, Vector3::Zero()},
                            .to = {1, {0, 0, 1}},
                            .stiffness = 100.0,
                            .damping = 3.0,
                            .free_length = 2.0});
  body.q.head<3>() << 0, 0, 4;  // the end is at z = 5, 3 m too long
  body.update();
  EXPECT_NEAR(spring.calc_tension(body.state()), 300.0, 1e-12);
  body.q.head<3>() << 0, 0, 0.5;
  body.update();
  EXPECT_NEAR(spring.calc_tension(body.state()), -50.0, 1e-12);
  examples::Random random(3);
  for (int i = 0; i < 10; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.update();
    expect_balanced(body, spring);
  }
}

TEST(PointSpring, RefusesWhatCannotBe) {
  EXPECT_THAT(
      [] {
        PointSpring({.name = "s7",
                     .from = {0, Vector3::Zero()},
                     .to = {1, Vector3::Zero()},
                     .stiffness = -1.0,
                     .free_length = 1.0});
      },
      ThrowsMessage<ModelError>(HasSubstr("\"s7\" has the stiffness")));
}

TEST(JointSpring, TurnsBackAndBalances) {
  MechanismBuilder builder;
  builder.add_body({.name = "arm",
                    .joint = {.kind = JointKind::revolute},
                    .mass = 1.0,
                    .p_BoBcm_B = Vector3::UnitX(),
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const JointSpring spring(
      mechanism,
      {.name = "s", .body = 1, .stiffness = 10.0, .damping = 2.0, .free_coordinate = 0.5});
  Kinematics kinematics(mechanism);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.7);
  const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, 3.0);
  Loads loads(mechanism);
  spring.add_forces({0.0, q, v, kinematics}, loads);
  EXPECT_NEAR(loads.tau[0], -2.0 - 6.0, 1e-14);
  const EnergyAccount account = spring.calc_energy({0.0, q, v, kinematics});
  EXPECT_NEAR(account.stored_energy, 0.2, 1e-14);
  EXPECT_NEAR(account.dissipated_power, 18.0, 1e-14);
}

TEST(JointFriction, HoldsWithAllItHasFromAFewCreepsOn) {
  MechanismBuilder builder;
  builder.add_body({.name = "hook",
                    .joint = {.kind = JointKind::revolute},
                    .mass = 1.0,
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const JointFriction::Definition bearing{
      .name = "bearing", .body = 1, .friction = 300.0, .creep = 1e-4};
  const JointFriction friction(mechanism, bearing);
  Kinematics kinematics(mechanism);
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(1);
  for (const double rate : {-0.2, -5e-5, 0.0, 0.003}) {
    const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, rate);
    Loads loads(mechanism);
    friction.add_forces({0.0, q, v, kinematics}, loads);
    const double full = rate < 0 ? 300.0 : -300.0;
    // Half a creep: tanh(0.5).
    const double share = rate == 0 ? 0.0 : rate == -5e-5 ? 0.46211715726000976 : 1.0;
    EXPECT_NEAR(loads.tau[0], full * share, 1e-9);
    const EnergyAccount account = friction.calc_energy({0.0, q, v, kinematics});
    EXPECT_DOUBLE_EQ(account.dissipated_power, -loads.tau[0] * rate);
    EXPECT_EQ(account.stored_energy, 0.0);
  }
  JointFriction::Definition wrong = bearing;
  wrong.creep = 0.0;
  EXPECT_THAT([&] { JointFriction(mechanism, wrong); },
              ThrowsMessage<ModelError>(HasSubstr("\"bearing\" is 300")));
  wrong = bearing;
  wrong.degree_of_freedom = 1;
  EXPECT_THAT([&] { JointFriction(mechanism, wrong); },
              ThrowsMessage<ModelError>(HasSubstr("degree of freedom 1 of the revolute joint")));
}

// Turned by an angle about any axis from the free orientation, the body is turned back about that
// axis.
TEST(TorsionalSpring, TurnsBackTheShorterWayAndBalances) {
  OneBody body;
  examples::Random random(5);
  for (int i = 0; i < 10; ++i) {
    const Matrix3 R_free = random.pose(1).R;
    const TorsionalSpring spring({.name = "s",
                                  .from = world_index,
                                  .to = 1,
                                  .stiffness = 100.0,
                                  .damping = 3.0,
                                  .R_FT_free = R_free});
    const Vector3 axis = random.direction();
    const double angle = random.uniform(0, 3);
    body.q.tail<4>() = quaternion_from_rotation(rotation_about(axis, angle) * R_free);
    body.v.setZero();
    body.update();
    EXPECT_LT((spring.calc_moment(body.state()) + 100.0 * angle * axis).norm(), 1e-10);
    EXPECT_NEAR(spring.calc_energy(body.state()).stored_energy, 50.0 * angle * angle, 1e-10);
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.update();
    expect_balanced(body, spring);
  }
}

TEST(TorsionalSpring, RefusesWhatCannotBe) {
  EXPECT_THAT([] { TorsionalSpring({.name = "s7", .from = 0, .to = 0, .stiffness = 1.0}); },
              ThrowsMessage<ModelError>(HasSubstr("\"s7\" has both ends on one body")));
  EXPECT_THAT([] { TorsionalSpring({.name = "s7", .from = 0, .to = 1, .stiffness = -1.0}); },
              ThrowsMessage<ModelError>(HasSubstr("\"s7\" has the stiffness")));
}

// 1/2 rho C A u^2 by hand: 0.5 * 1.25 * 1.6 * 10 * 64 = 640 N straight on; at 60 degrees to the
// normal a quarter of it, along the normal.
TEST(WindArea, FlatAreaFollowsItsNormal) {
  OneBody body;
  const Wind wind = Wind::level(8.0, std::numbers::pi / 3);
  const WindArea area(wind, {.name = "w",
                             .centre_of_pressure = {1, Vector3::Zero()},
                             .area = 10.0,
                             .coefficient = 1.6,
                             .normal_B = Vector3(-2, 0, 0)});
  EXPECT_LT((area.calc_force(body.state()) - Vector3(160, 0, 0)).norm(), 1e-10);
  examples::Random random(4);
  body.q = examples::random_configuration(random, body.mechanism);
  body.v = random.values(6, 1);
  body.update();
  expect_balanced(body, area);
}

TEST(WindArea, WithoutDirectionFollowsTheRelativeWind) {
  OneBody body;
  const WindArea area(Wind::level(8.0, 0.0), {.name = "w",
                                              .centre_of_pressure = {1, Vector3::Zero()},
                                              .area = 10.0,
                                              .coefficient = 1.6,
                                              .normal_B = {}});
  EXPECT_LT((area.calc_force(body.state()) - Vector3(640, 0, 0)).norm(), 1e-10);
  body.v.tail<3>() << 8, 0, 0;  // runs with the wind
  body.update();
  EXPECT_LT(area.calc_force(body.state()).norm(), 1e-10);
  expect_balanced(body, area);
}

TEST(SupportPad, CarriesRubsAndLetsGo) {
  OneBody body;
  const SupportPad pad({.name = "p",
                        .point = {1, {0, 0, -1}},
                        .p_WG = Vector3::Zero(),
                        .stiffness = 1000.0,
                        .damping = 50.0,
                        .friction_coefficient = 0.3,
                        .tangential_stiffness = 1000.0});
  body.q.head<3>() << 0, 0, 0.9;  // 0.1 m deep
  body.update();
  EXPECT_NEAR(pad.calc_load(body.kinematics).normal_force, 100.0, 1e-10);
  body.q.head<3>() << 0.02, 0, 0.9;  // elastic friction
  body.update();
  EXPECT_NEAR(pad.calc_load(body.kinematics).force_W.x(), -20.0, 1e-10);
  body.q.head<3>() << 0.2, 0, 0.9;  // slides: mu N
  body.update();
  EXPECT_NEAR(pad.calc_load(body.kinematics).force_W.x(), -30.0, 1e-10);
  body.q.head<3>() << 0.2, 0, 1.1;  // in the air
  body.update();
  EXPECT_EQ(pad.calc_load(body.kinematics).force_W.norm(), 0.0);
}

// Beside a pad that ends there is no ground: a load goes lower there.
TEST(SupportPad, EndsAtItsReach) {
  OneBody body;
  const SupportPad pad({.name = "p",
                        .point = {1, Vector3::Zero()},
                        .p_WG = {1, 2, 0},
                        .stiffness = 1000.0,
                        .reach = 5.0});
  const auto normal_force_at = [&](const Vector3& place) {
    body.q.head<3>() = place;
    body.update();
    return pad.calc_load(body.kinematics).normal_force;
  };
  EXPECT_NEAR(normal_force_at({4, 2, -0.1}), 100.0, 1e-10);
  EXPECT_EQ(normal_force_at({1, 7.5, -3}), 0.0);
  EXPECT_EQ(normal_force_at({1, 7.5, 3}), 0.0);
}

}  // namespace
}  // namespace blocklift::dynamics
