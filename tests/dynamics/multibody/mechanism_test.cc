// The builder's messages, and how a mechanism numbers its parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

BodyDefinition trolley() {
  BodyDefinition body;
  body.name = "trolley";
  body.joint = {JointKind::prismatic, Vector3(2, 0, 0)};
  body.mass = 10;
  return body;
}

std::string message_of(const std::vector<BodyDefinition>& bodies) {
  MechanismBuilder builder;
  try {
    for (const BodyDefinition& body : bodies) builder.add_body(body);
    builder.build();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

template <class Change>
std::string refusal_after(Change change) {
  BodyDefinition body = trolley();
  change(body);
  return message_of({body});
}

TEST(MechanismBuilder, AcceptsASoundBody) { EXPECT_EQ(message_of({trolley()}), ""); }

TEST(MechanismBuilder, TellsWhatIsWrongWithABody) {
  EXPECT_THAT(refusal_after([](auto& b) { b.name = ""; }), HasSubstr("has no name"));
  EXPECT_THAT(refusal_after([](auto& b) { b.name = "world"; }), HasSubstr("names must differ"));
  EXPECT_THAT(refusal_after([](auto& b) { b.parent = "girder"; }),
              HasSubstr("body \"trolley\": its parent \"girder\" is not there; parents come before "
                        "children, and so far there are: world"));
  EXPECT_THAT(refusal_after([](auto& b) { b.mass = not_a_number; }), HasSubstr("no mass is given"));
  EXPECT_THAT(refusal_after([](auto& b) { b.mass = -3; }), HasSubstr("its mass is -3 kg"));
  EXPECT_THAT(refusal_after([](auto& b) { b.p_BoBcm_B[1] = not_a_number; }),
              HasSubstr("centre of mass is not finite"));
  EXPECT_THAT(refusal_after([](auto& b) { b.joint.axis.setZero(); }),
              HasSubstr("its joint's axis (0, 0, 0) has no direction"));
  EXPECT_THAT(refusal_after([](auto& b) {
                b.damping = {1, 2};
              }),
              HasSubstr("it has 2 damping values; its prismatic joint takes 1 or none"));
  EXPECT_THAT(refusal_after([](auto& b) { b.damping = {-1}; }), HasSubstr("its damping -1"));
  EXPECT_THAT(refusal_after([](auto& b) { b.X_PJ.R *= 2; }), HasSubstr("not a rotation matrix"));
  EXPECT_THAT(refusal_after([](auto& b) { b.X_PJ.p[0] = not_a_number; }),
              HasSubstr("place of its joint"));
}

TEST(MechanismBuilder, RefusesInertiaThatNoBodyHas) {
  EXPECT_THAT(refusal_after([](auto& b) { b.I_BBcm_B = Vector3(1, 1, 3).asDiagonal(); }),
              HasSubstr("principal moments of inertia (1, 1, 3)"));
  EXPECT_THAT(refusal_after([](auto& b) { b.I_BBcm_B = Vector3(-1, 1, 1).asDiagonal(); }),
              HasSubstr("principal moments"));
  EXPECT_THAT(refusal_after([](auto& b) { b.I_BBcm_B(0, 1) = 1; }), HasSubstr("not symmetric"));
  EXPECT_THAT(refusal_after([](auto& b) {
                b.mass = 0;
                b.I_BBcm_B.setIdentity();
              }),
              HasSubstr("inertia but no mass"));
  // A slender rod is the limit case and is allowed.
  EXPECT_EQ(refusal_after([](auto& b) { b.I_BBcm_B = Vector3(0, 1, 1).asDiagonal(); }), "");
}

TEST(MechanismBuilder, WantsPerpendicularAxes) {
  EXPECT_THAT(refusal_after([](auto& b) {
                b.joint = {JointKind::universal, Vector3::UnitX(), Vector3(1, 1, 0)};
              }),
              HasSubstr("enclose 45 degrees; 90 are due"));
}

TEST(MechanismBuilder, DrivesAQuaternionJointAsAWhole) {
  const auto message = refusal_after([](auto& b) {
    b.joint.kind = JointKind::spherical;
    b.driven = {true, false, false};
  });
  EXPECT_THAT(message, HasSubstr("all or none"));
}

TEST(MechanismBuilder, RefusesTwoBodiesOfOneName) {
  EXPECT_THAT(message_of({trolley(), trolley()}), HasSubstr("body \"trolley\": there is a body"));
}

TEST(MechanismBuilder, AllowsMasslessBodiesThatCarryMassOrAreDriven) {
  BodyDefinition bare = trolley();
  bare.mass = 0;
  EXPECT_THAT(message_of({bare}),
              HasSubstr("its prismatic joint moves freely but carries no mass"));
  BodyDefinition load = trolley();
  load.name = "load";
  load.parent = "trolley";
  load.joint.axis = Vector3::UnitY();
  EXPECT_EQ(message_of({bare, load}), "");
  bare.driven = {true};
  EXPECT_EQ(message_of({bare}), "");
}

TEST(Mechanism, NumbersBodiesAndVelocitiesInOrder) {
  MechanismBuilder builder;
  BodyDefinition driven = trolley();
  driven.driven = {true};
  EXPECT_EQ(builder.add_body(driven), 1);
  BodyDefinition hull = trolley();
  hull.name = "hull";
  hull.joint.kind = JointKind::free;
  EXPECT_EQ(builder.add_body(hull), 2);
  const Mechanism mechanism = builder.build();
  EXPECT_EQ(mechanism.body_count(), 3);
  EXPECT_EQ(mechanism.nq(), 8);
  EXPECT_EQ(mechanism.nv(), 7);
  EXPECT_EQ(mechanism.body_index("hull"), 2);
  EXPECT_EQ(mechanism.body_index("world"), world_index);
  EXPECT_THAT(mechanism.driven_velocities(), ElementsAre(0));
  EXPECT_THAT(mechanism.driven_coordinates(), ElementsAre(0));
  EXPECT_THAT(mechanism.free_velocities(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(mechanism.free_coordinates(), ElementsAre(1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(mechanism.zero_configuration()[4], 1.0);  // the quaternion's w
  EXPECT_EQ(mechanism.velocity_name(0), "\"trolley\" (prismatic)");
  EXPECT_EQ(mechanism.velocity_name(6), "\"hull\" (free, velocity 6 of 6, displacing)");
  try {
    mechanism.body_index("hul");
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("there is no body \"hul\"; the bodies are: world, trolley, hull"));
  }
}

TEST(Mechanism, NamesTheBodyWhoseQuaternionIsLost) {
  MechanismBuilder builder;
  BodyDefinition hull = trolley();
  hull.joint.kind = JointKind::free;
  builder.add_body(hull);
  const Mechanism mechanism = builder.build();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(7);
  EXPECT_THROW(mechanism.normalise(q), SimulationError);
}

TEST(JointKind, NamesAndKindsAreOneToOne) {
  for (const std::string_view name : joint_kind_names()) {
    EXPECT_EQ(joint_kind_name(*joint_kind(name)), name);
  }
  EXPECT_FALSE(joint_kind("hinge"));
}

// A point mass on the axis of its own revolute joint: sound to the builder, singular to the
// dynamics.
TEST(ForwardDynamics, NamesTheBodyThatNothingResists) {
  MechanismBuilder builder;
  BodyDefinition hook = trolley();
  hook.name = "hook";
  hook.joint.kind = JointKind::revolute;
  builder.add_body(hook);
  const Mechanism mechanism = builder.build();
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(1);
  Eigen::VectorXd vdot(1);
  const auto message = [&](double q) -> std::string {
    compute_kinematics(mechanism, Eigen::VectorXd::Constant(1, q), tau, kinematics);
    try {
      compute_forward_dynamics(mechanism, kinematics, tau, examples::no_forces(mechanism),
                               workspace, tau, vdot);
    } catch (const SimulationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(0.3), HasSubstr("body \"hook\" (revolute): nothing resists this motion"));
  EXPECT_THAT(message(not_a_number), HasSubstr("body \"hook\": its pose is not finite"));
}

}  // namespace
}  // namespace blocklift::dynamics
