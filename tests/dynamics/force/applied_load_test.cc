#include "dynamics/force/applied_load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/force/spring.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

using test::expect_balanced;
using test::OneBody;

TEST(LoadTable, IsStraightBetweenPointsAndConstantBeyond) {
  const LoadTable table({1.0, 3.0, 4.0}, {{1, 0, 0}, {5, 2, 0}, {0, 0, 1}});
  EXPECT_EQ(table.evaluate(0.0), Vector3(1, 0, 0));
  EXPECT_EQ(table.evaluate(1.0), Vector3(1, 0, 0));
  EXPECT_TRUE(table.evaluate(1.5).isApprox(Vector3(2, 0.5, 0), 1e-15));
  EXPECT_TRUE(table.evaluate(3.25).isApprox(Vector3(3.75, 1.5, 0.25), 1e-15));
  EXPECT_EQ(table.evaluate(9.0), Vector3(0, 0, 1));
  EXPECT_EQ(LoadTable(Vector3(1, 2, 3)).evaluate(7.0), Vector3(1, 2, 3));
}

TEST(LoadTable, RefusesTimesThatDoNotAscend) {
  EXPECT_THAT(
      [] {
        LoadTable({0.0, 2.0, 2.0}, std::vector(3, Vector3::UnitX().eval()));
      },
      ThrowsMessage<ModelError>(HasSubstr("must ascend")));
  EXPECT_THAT([] { LoadTable({0.0}, {}); },
              ThrowsMessage<ModelError>(HasSubstr("1 times and 0 values")));
}

TEST(AppliedLoad, KeepsItsDirectionOrTurnsWithTheBody) {
  OneBody body;
  body.q << 0, 0, 0, std::sqrt(0.5), 0, 0, std::sqrt(0.5);  // a quarter turn about z: x_B is y_W
  body.update();
  const auto force_with = [&](AppliedLoad::Axes axes) {
    const AppliedLoad load({.name = "f",
                            .point = {1, {2, 0, 0}},
                            .axes = axes,
                            .force = LoadTable(Vector3(3, 0, 0)),
                            .moment = LoadTable(Vector3(0, 5, 0))});
    body.loads.set_zero();
    load.add_forces(body.state(), body.loads);
    return body.loads.F_Bo_W[1];
  };
  // The point is at (0, 2, 0) in the world.
  const ForceVector in_world = force_with(AppliedLoad::Axes::world);
  EXPECT_TRUE(in_world.force.isApprox(Vector3(3, 0, 0), 1e-15));
  EXPECT_TRUE(in_world.moment.isApprox(Vector3(0, 5, -6), 1e-15));
  const ForceVector in_body = force_with(AppliedLoad::Axes::body);
  EXPECT_TRUE(in_body.force.isApprox(Vector3(0, 3, 0), 1e-15));
  EXPECT_TRUE(in_body.moment.isApprox(Vector3(-5, 0, 0), 1e-15));
}

TEST(AppliedLoad, AccountsForItsPower) {
  OneBody body;
  examples::Random random(5);
  for (const auto axes : {AppliedLoad::Axes::world, AppliedLoad::Axes::body}) {
    const AppliedLoad load({.name = "f",
                            .point = {1, random.vector(2)},
                            .axes = axes,
                            .force = LoadTable({0.0, 1.0}, {random.vector(3), random.vector(3)}),
                            .moment = LoadTable(random.vector(3))});
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.time = 0.3;
    body.update();
    expect_balanced(body, load);
  }
}

TEST(AppliedLoad, RefusesTheWorld) {
  EXPECT_THAT(
      [] {
        AppliedLoad({.name = "f", .point = {world_index, Vector3::Zero()}});
      },
      ThrowsMessage<ModelError>(HasSubstr("load \"f\" acts on the world")));
}

TEST(JointLoad, ActsAtItsDegreeOfFreedomAndAccountsForItsPower) {
  OneBody body;
  const JointLoad load(body.mechanism,
                       {.name = "thrust",
                        .body = 1,
                        .degree_of_freedom = 4,
                        .load = LoadTable({0.0, 2.0}, {Vector3::Zero(), {8, 0, 0}})});
  body.v << 1, 2, 3, 4, 5, 6;
  body.time = 0.5;
  body.update();
  load.add_forces(body.state(), body.loads);
  EXPECT_DOUBLE_EQ(body.loads.tau[4], 2.0);
  EXPECT_DOUBLE_EQ(body.loads.tau.cwiseAbs().sum(), 2.0);
  EXPECT_DOUBLE_EQ(load.calc_energy(body.state()).supplied_power, 10.0);
  EXPECT_THAT([&] { JointLoad(body.mechanism, {.name = "f7", .body = 1, .degree_of_freedom = 6}); },
              ThrowsMessage<ModelError>(HasSubstr("load \"f7\" acts at degree of freedom 6")));
}

TEST(JointSpring, ActsAtOneDegreeOfFreedomOfSeveral) {
  MechanismBuilder builder;
  builder.add_body({.name = "pin",
                    .joint = {.kind = JointKind::cylindrical},
                    .mass = 1.0,
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  const JointSpring spring(mechanism, {.name = "s",
                                       .body = 1,
                                       .degree_of_freedom = 1,
                                       .stiffness = 10.0,
                                       .damping = 2.0,
                                       .free_coordinate = 0.5});
  Kinematics kinematics(mechanism);
  const Eigen::Vector2d q(3.0, 1.5), v(7.0, 0.25);
  Loads loads(mechanism);
  spring.add_forces({0.0, q, v, kinematics}, loads);
  EXPECT_DOUBLE_EQ(loads.tau[0], 0.0);
  EXPECT_DOUBLE_EQ(loads.tau[1], -10.5);
}

}  // namespace
}  // namespace blocklift::dynamics
