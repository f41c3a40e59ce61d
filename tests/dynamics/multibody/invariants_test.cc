// What nature conserves, the recursive dynamics must conserve too: to the error of the integration.
#include <gtest/gtest.h>

#include "dynamics/multibody/energy.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/multibody/runge_kutta.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using test::RungeKutta;

// A free body that carries one body on each kind of joint, and bodies on those.
Mechanism floating_tree(Random& random, const Vector3& gravity) {
  MechanismBuilder builder;
  builder.set_gravity(gravity);
  builder.add_body(examples::random_body(random, JointKind::free, "hull", "world"));
  for (const std::string_view name : joint_kind_names()) {
    const std::string body(name);
    builder.add_body(examples::random_body(random, *joint_kind(name), body, "hull"));
    builder.add_body(examples::random_body(random, JointKind::revolute, body + "-arm", body));
  }
  return builder.build();
}

TEST(FreeSystem, ConservesMomentumAndEnergy) {
  Random random(11);
  const Mechanism mechanism = floating_tree(random, Vector3::Zero());
  RungeKutta run(mechanism, examples::random_configuration(random, mechanism),
                 random.values(mechanism.nv(), 0.5));
  const ForceVector momentum = calc_momentum(mechanism, run.kinematics());
  const double energy = calc_kinetic_energy(mechanism, run.kinematics());
  run.advance(0.5, 1000);
  const ForceVector later = calc_momentum(mechanism, run.kinematics());
  // The step's error is of the order (h |rates|)^4 = (5e-4 * 10)^4 = 6e-10 of each.
  EXPECT_LT((later.force - momentum.force).norm(), 1e-9 * momentum.force.norm());
  EXPECT_LT((later.moment - momentum.moment).norm(), 1e-9 * momentum.moment.norm());
  EXPECT_NEAR(calc_kinetic_energy(mechanism, run.kinematics()), energy, 1e-9 * energy);
}

TEST(FreeSystem, CentreOfMassFallsLikeAPoint) {
  Random random(12);
  const Vector3 gravity(0, 0, -9.81);
  const Mechanism mechanism = floating_tree(random, gravity);
  RungeKutta run(mechanism, examples::random_configuration(random, mechanism),
                 random.values(mechanism.nv(), 0.5));
  const RigidBodyInertia start = calc_mass_properties(mechanism, run.kinematics());
  const Vector3 velocity = calc_momentum(mechanism, run.kinematics()).force / start.mass;
  run.advance(1.0, 2000);
  const Vector3 p = calc_mass_properties(mechanism, run.kinematics()).p_BoBcm;
  EXPECT_LT((p - (start.p_BoBcm + velocity + 0.5 * gravity)).norm(), 1e-9);
}

TEST(ConservativeSystem, KeepsItsEnergy) {
  Random random(13);
  MechanismBuilder builder;
  std::string parent(world_name);
  for (int i = 0; i < 5; ++i) {
    const std::string name = "link" + std::to_string(i);
    const JointKind kind = i == 2 ? JointKind::spherical : JointKind::revolute;
    builder.add_body(examples::random_body(random, kind, name, parent));
    parent = name;
  }
  const Mechanism mechanism = builder.build();
  RungeKutta run(mechanism, examples::random_configuration(random, mechanism),
                 random.values(mechanism.nv(), 1));
  const auto energy = [&] {
    const Kinematics k = run.kinematics();
    return calc_kinetic_energy(mechanism, k) + calc_gravity_potential(mechanism, k);
  };
  const double start = energy();
  const double scale = calc_kinetic_energy(mechanism, run.kinematics()) + std::abs(start);
  run.advance(0.3, 1500);
  EXPECT_NEAR(energy(), start, 1e-8 * scale);
}

// A long spin about the axis of largest inertia returns to where it should be, and stays a
// rotation.
TEST(FreeBody, SpinsForAHundredRevolutions) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  BodyDefinition body;
  body.name = "top";
  body.joint.kind = JointKind::free;
  body.mass = 2;
  body.I_BBcm_B = Vector3(1, 2, 2.5).asDiagonal();
  builder.add_body(body);
  const Mechanism mechanism = builder.build();
  Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  v[2] = 2 * M_PI;
  RungeKutta run(mechanism, mechanism.zero_configuration(), v);
  run.advance(100.0, 10000);
  const Matrix3 R = run.kinematics().X_WB[1].R;
  EXPECT_LT((R.transpose() * R - Matrix3::Identity()).norm(), 1e-14);
  // Phase error of the classical method: (h w/2)^5 / 120 a step, the quaternion turning at w / 2.
  EXPECT_LT((R - Matrix3::Identity()).norm(), 1e-5);
}

// The length of a quaternion is nobody's care: poses and accelerations do not depend on it.
TEST(Quaternion, OfAnyLengthGivesTheSameMotion) {
  Random random(14);
  const Mechanism mechanism = floating_tree(random, Vector3(0, 0, -9.81));
  Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const Eigen::VectorXd v = random.values(mechanism.nv(), 1);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(mechanism.nv());
  Eigen::VectorXd unit(mechanism.nv());
  Eigen::VectorXd scaled(mechanism.nv());
  Kinematics kinematics(mechanism);
  ForwardDynamicsWorkspace workspace(mechanism);
  const auto forces = examples::no_forces(mechanism);
  compute_kinematics(mechanism, q, v, kinematics);
  compute_forward_dynamics(mechanism, kinematics, v, forces, workspace, tau, unit);
  q.segment<4>(3) *= 1.5;
  compute_kinematics(mechanism, q, v, kinematics);
  compute_forward_dynamics(mechanism, kinematics, v, forces, workspace, tau, scaled);
  EXPECT_LT((unit - scaled).norm(), 1e-12 * unit.norm());
}

// A mechanism in which a body is fixed to another equals the one in which both are one body.
TEST(FixedBody, IsPartOfItsCarrier) {
  Random random(15);
  const BodyDefinition boom = examples::random_body(random, JointKind::universal, "boom", "world");
  const BodyDefinition head = examples::random_body(random, JointKind::fixed, "head", "boom");
  const BodyDefinition hook = examples::random_body(random, JointKind::spherical, "hook", "head");
  MechanismBuilder two;
  two.add_body(boom);
  two.add_body(head);
  two.add_body(hook);

  const auto inertia_of = [](const BodyDefinition& body) {
    return RigidBodyInertia{body.mass, body.p_BoBcm_B, Symmetric3::of(body.I_BBcm_B)};
  };
  const RigidBodyInertia both = inertia_of(boom) + transform(head.X_PJ, inertia_of(head));
  BodyDefinition merged = boom;
  merged.mass = both.mass;
  merged.p_BoBcm_B = both.p_BoBcm;
  merged.I_BBcm_B = both.I_BBcm.matrix();
  BodyDefinition hook_on_boom = hook;
  hook_on_boom.parent = "boom";
  hook_on_boom.X_PJ = head.X_PJ * hook.X_PJ;
  MechanismBuilder one;
  one.add_body(merged);
  one.add_body(hook_on_boom);

  Eigen::VectorXd accelerations[2];
  int i = 0;
  for (const Mechanism& mechanism : {two.build(), one.build()}) {
    const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(mechanism.nq(), 0.3, 0.9);
    const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(mechanism.nv(), -1, 1);
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(mechanism.nv());
    accelerations[i].resize(mechanism.nv());
    Kinematics kinematics(mechanism);
    ForwardDynamicsWorkspace workspace(mechanism);
    auto forces = examples::no_forces(mechanism);
    compute_kinematics(mechanism, q, v, kinematics);
    // A force at the head's origin, on whichever body the head is.
    const bool apart = mechanism.has_body("head");
    add_point_force(kinematics, mechanism.body_index(apart ? "head" : "boom"),
                    apart ? Vector3::Zero().eval() : head.X_PJ.p, Vector3(1, 2, 3), forces);
    compute_forward_dynamics(mechanism, kinematics, v, forces, workspace, tau, accelerations[i++]);
  }
  EXPECT_LT((accelerations[0] - accelerations[1]).norm(), 1e-12 * accelerations[0].norm());
}

}  // namespace
}  // namespace blocklift::dynamics
