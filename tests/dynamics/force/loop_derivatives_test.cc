// What the forces of loops do by the motion, against central differences of G^T lambda, for every
// kind of loop between bodies of a random tree, on and off the constraint.
#include "dynamics/force/loop_derivatives.h"

#include <gtest/gtest.h>

#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

LoopDefinition random_loop(Random& random, LoopKind kind) {
  LoopDefinition loop;
  loop.name = loop_kind_name(kind);
  loop.kind = kind;
  loop.first = "a2";
  loop.second = "b1";
  loop.X_FirstK = random.pose(1);
  loop.X_SecondK = random.pose(1);
  if (kind == LoopKind::rope_length) {
    loop.first = loop.second = std::string(world_name);
    loop.X_FirstK = loop.X_SecondK = Pose::identity();
    const auto point = [&](const char* body) { return LoopPoint{body, random.vector(1)}; };
    loop.paths = {{point("world"), point("a1"), point("b1")}, {point("a2"), point("world")}};
    loop.length = 3;
  }
  if (kind == LoopKind::distance) {
    loop.X_FirstK.R = loop.X_SecondK.R = Matrix3::Identity();
    loop.length = 2;
  }
  return loop;
}

class LoopDerivatives : public ::testing::TestWithParam<LoopKind> {};

TEST_P(LoopDerivatives, AreThoseOfDifferences) {
  Random random(11);
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body(examples::random_body(random, JointKind::free, "a1", "world"));
  builder.add_body(examples::random_body(random, JointKind::universal, "a2", "a1"));
  builder.add_body(examples::random_body(random, JointKind::spherical, "b1", "world"));
  builder.add_loop(random_loop(random, GetParam()));
  const Mechanism mechanism = builder.build();
  const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(mechanism.nv());
  const Eigen::VectorXd lambda = random.values(mechanism.loop_row_count(), 5);

  const auto forces = [&](const Eigen::VectorXd& at) {
    Kinematics kinematics(mechanism);
    LoopState state(mechanism);
    compute_kinematics(mechanism, at, rest, kinematics);
    compute_loops(mechanism, kinematics, at, rest, state);
    return Eigen::VectorXd(calc_loop_jacobian(mechanism, kinematics, state).transpose() * lambda);
  };
  Eigen::MatrixXd reference(mechanism.nv(), mechanism.nv());
  constexpr double h = 1e-5;
  Eigen::VectorXd moved(mechanism.nq());
  for (Eigen::Index k = 0; k < mechanism.nv(); ++k) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(mechanism.nv(), k);
    mechanism.integrate(q, e, h, moved);
    reference.col(k) = forces(moved);
    mechanism.integrate(q, e, -h, moved);
    reference.col(k) = (reference.col(k) - forces(moved)) / (2 * h);
  }

  Kinematics kinematics(mechanism);
  LoopState state(mechanism);
  compute_kinematics(mechanism, q, rest, kinematics);
  compute_loops(mechanism, kinematics, q, rest, state);
  MotionColumns columns(mechanism);
  compute_motion_columns(mechanism, kinematics, rest, columns);
  ForceDerivatives derivatives(mechanism, 2);
  derivatives.start(kinematics, columns);
  add_loop_derivatives(mechanism, kinematics, state, lambda, derivatives);
  std::vector<ForceVector> F_Bo_W = examples::no_forces(mechanism);
  Eigen::VectorXd tau = rest;
  add_loop_forces(mechanism, kinematics, state, lambda, F_Bo_W, tau);
  InverseDynamicsDerivatives held(mechanism);
  compute_inverse_dynamics_derivatives(mechanism, kinematics, rest, rest, F_Bo_W,
                                       derivatives.arm_moments(), held);
  const Eigen::MatrixXd result = derivatives.dtau_dq() - held.dtau_dq;
  EXPECT_LT((result - reference).lpNorm<Eigen::Infinity>(),
            1e-8 * (1 + reference.lpNorm<Eigen::Infinity>()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, LoopDerivatives,
                         ::testing::Values(LoopKind::fixed, LoopKind::revolute, LoopKind::prismatic,
                                           LoopKind::cylindrical, LoopKind::universal,
                                           LoopKind::spherical, LoopKind::planar,
                                           LoopKind::translational, LoopKind::distance,
                                           LoopKind::point_on_line, LoopKind::rope_length),
                         [](const auto& kind) { return std::string(loop_kind_name(kind.param)); });

}  // namespace
}  // namespace blocklift::dynamics
