// Dynamics with loops against the same mechanism as a tree, against closed forms and references.
#include "dynamics/multibody/constrained_dynamics.h"

#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

/// A state with all that constrained dynamics finds there.
struct Solution {
  Solution(const Mechanism& m, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
           const std::vector<ForceVector>& forces, Eigen::VectorXd tau_given,
           Eigen::VectorXd vdot_given)
      : kinematics(m), w(m), tau(std::move(tau_given)), vdot(std::move(vdot_given)) {
    compute_kinematics(m, q, v, kinematics);
    compute_constrained_dynamics(m, kinematics, q, v, forces, nullptr, w, tau, vdot);
  }
  Solution(const Mechanism& m, const Eigen::VectorXd& q, const Eigen::VectorXd& v)
      : Solution(m, q, v, examples::no_forces(m), Eigen::VectorXd::Zero(m.nv()),
                 Eigen::VectorXd::Zero(m.nv())) {}

  Kinematics kinematics;
  ConstrainedDynamicsWorkspace w;
  Eigen::VectorXd tau, vdot;
};

// Chain arm1 - arm2 - B - tip, B on arm2 by a joint of the kind; and the same with B flying freely
// and a loop in place of the joint, either way round.
struct CutJoint {
  CutJoint(JointKind kind, bool reversed, unsigned seed) : random(seed) {
    BodyDefinition arm1 = examples::random_body(random, JointKind::universal, "arm1", "world");
    BodyDefinition arm2 = examples::random_body(random, JointKind::revolute, "arm2", "arm1");
    arm2.driven = {true};
    BodyDefinition B = examples::random_body(random, kind, "B", "arm2");
    const BodyDefinition tip = examples::random_body(random, JointKind::spherical, "tip", "B");
    MechanismBuilder joined;
    MechanismBuilder cut;
    for (const BodyDefinition& body : {arm1, arm2, B, tip}) joined.add_body(body);
    LoopDefinition loop;
    loop.name = "cut";
    loop.kind = loop_kind(joint_kind_name(kind)).value();
    loop.first = "arm2";
    loop.second = "B";
    loop.X_FirstK = B.X_PJ;
    loop.axis = B.joint.axis;
    if (kind == JointKind::universal) loop.second_axis = B.joint.second_axis;
    if (kind == JointKind::spherical || kind == JointKind::fixed ||
        kind == JointKind::translational) {
      loop.axis = Vector3::UnitZ();
    }
    if (reversed) {
      std::swap(loop.first, loop.second);
      std::swap(loop.X_FirstK, loop.X_SecondK);
      if (kind == JointKind::universal) std::swap(loop.axis, loop.second_axis);
    }
    B.parent = world_name;
    B.X_PJ = random.pose(1);
    B.joint = {JointKind::free, Vector3::UnitZ()};
    for (const BodyDefinition& body : {arm1, arm2, B, tip}) cut.add_body(body);
    cut.add_loop(loop);
    tree.emplace(joined.build());
    looped.emplace(cut.build());
  }

  Random random;
  std::optional<Mechanism> tree, looped;
};

class EveryJointKind : public ::testing::TestWithParam<JointKind> {};

TEST_P(EveryJointKind, LoopMovesAsTheTreesJointDoes) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CutJoint pair(GetParam(), seed % 2 == 0, seed);
    const Mechanism& tree = *pair.tree;
    const Mechanism& looped = *pair.looped;
    const Eigen::VectorXd q = examples::random_configuration(pair.random, tree);
    const Eigen::VectorXd v = pair.random.values(tree.nv(), 2);
    Kinematics kinematics(tree);
    compute_kinematics(tree, q, v, kinematics);
    const std::vector<ForceVector> forces = examples::random_forces(pair.random, tree);
    ForwardDynamicsWorkspace forward(tree);
    Eigen::VectorXd tau = pair.random.values(tree.nv(), 1);
    Eigen::VectorXd vdot = pair.random.values(tree.nv(), 1);
    // The cut joint's own force has no counterpart in the loop.
    const Body& B = tree.body(3);
    tau.segment(B.v_offset, B.nv()).setZero();

    // The same state of the looped mechanism: B's own coordinates from where it is.
    Eigen::VectorXd q_loop(looped.nq()), v_loop(looped.nv()), tau_loop(looped.nv()),
        vdot_loop(looped.nv());
    const auto tip_q = tree.body(4).nq();
    const auto tip_v = tree.body(4).nv();
    const Body& free_B = looped.body(3);
    const Pose X_JB = free_B.X_PJ.inverse() * kinematics.X_WB[3];
    q_loop << q.head(3), X_JB.p, quaternion_from_rotation(X_JB.R), q.tail(tip_q);
    const Matrix3 R_BW = kinematics.X_WB[3].R.transpose();
    v_loop << v.head(3), R_BW * kinematics.V_WB[3].angular, R_BW * kinematics.V_WB[3].linear,
        v.tail(tip_v);
    tau_loop << tau.head(3), Eigen::VectorXd::Zero(6), tau.tail(tip_v);
    vdot_loop << vdot.head(3), Eigen::VectorXd::Zero(6), vdot.tail(tip_v);

    compute_forward_dynamics(tree, kinematics, v, forces, forward, tau, vdot);
    const Solution found(looped, q_loop, v_loop, forces, tau_loop, vdot_loop);
    EXPECT_LT(found.w.loops.residual.lpNorm<Eigen::Infinity>(), 1e-14);
    EXPECT_LT(found.w.loops.velocity.lpNorm<Eigen::Infinity>(), 1e-13);

    std::vector<MotionVector> A_tree(5), A_loop(5);
    compute_accelerations(tree, kinematics, vdot, A_tree);
    compute_accelerations(looped, found.kinematics, found.vdot, A_loop);
    for (std::size_t i = 1; i < 5; ++i) {
      const double size = 1 + A_tree[i].angular.norm() + A_tree[i].linear.norm();
      EXPECT_LT((A_loop[i].angular - A_tree[i].angular).norm(), 1e-10 * size) << "body " << i;
      EXPECT_LT((A_loop[i].linear - A_tree[i].linear).norm(), 1e-10 * size) << "body " << i;
    }
    // The drive of arm2 and the reaction in the joint are the same, too.
    EXPECT_NEAR(found.tau[2], tau[2], 1e-10 * (1 + std::abs(tau[2])));
    InverseDynamicsWorkspace inverse(tree);
    Eigen::VectorXd unused(tree.nv());
    compute_inverse_dynamics(tree, kinematics, v, vdot, forces, inverse, unused);
    ForceVector F = loop_force(looped, found.kinematics, found.w.loops, 0, found.w.lambda);
    if (seed % 2 == 0) {
      // Reversed: the force is on arm2 at its own frame.
      const Vector3 p = found.kinematics.X_WB[2].apply(looped.loops()[0].X_FollowerK.p);
      F = -1.0 * shift_to(F, p - found.kinematics.X_WB[3].p);
    }
    const ForceVector& wanted = inverse.F_joint_W[3];
    const double size = 1 + wanted.moment.norm() + wanted.force.norm();
    EXPECT_LT((F.moment - wanted.moment).norm(), 1e-10 * size);
    EXPECT_LT((F.force - wanted.force).norm(), 1e-10 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryJointKind,
                         ::testing::Values(JointKind::fixed, JointKind::revolute,
                                           JointKind::prismatic, JointKind::cylindrical,
                                           JointKind::universal, JointKind::spherical,
                                           JointKind::planar, JointKind::translational),
                         [](const auto& info) { return std::string(joint_kind_name(info.param)); });

// Test Set for IVP Solvers: at rest at t = 0, beta'' = 14222.4439199541, Theta'' =
// -10666.8329399656, the others zero (to 11 digits).
class Andrews : public ::testing::TestWithParam<LoopKind> {};

TEST_P(Andrews, AccelerationsAtTheStart) {
  const Mechanism m = test::AndrewsSqueezer{GetParam()}.build();
  Eigen::VectorXd q = test::AndrewsSqueezer::q_start();
  assemble(m, q);
  EXPECT_LT((q - test::AndrewsSqueezer::q_start()).norm(), 1e-14);
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(7);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(7);
  tau[0] = test::AndrewsSqueezer::moment;
  Kinematics kinematics(m);
  compute_kinematics(m, q, v, kinematics);
  std::vector<ForceVector> forces = examples::no_forces(m);
  const BodyIndex K3 = m.body_index("K3");
  const Vector3 p_WD = point_position(kinematics, K3, test::AndrewsSqueezer::p_K3D);
  const Vector3 line = test::AndrewsSqueezer::p_WC - p_WD;
  const double tension = test::AndrewsSqueezer::spring_stiffness *
                         (line.norm() - test::AndrewsSqueezer::spring_free_length);
  add_point_force(kinematics, K3, test::AndrewsSqueezer::p_K3D, tension * line.normalized(),
                  forces);
  const Solution found(m, q, v, forces, tau, Eigen::VectorXd::Zero(7));
  EXPECT_EQ(found.w.rank, 6);
  EXPECT_NEAR(found.vdot[0], 14222.4439199541, 1e-9 * 14222);
  EXPECT_NEAR(found.vdot[1], -10666.8329399656, 1e-9 * 10667);
  EXPECT_LT(found.vdot.tail(5).lpNorm<Eigen::Infinity>(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Loops, Andrews,
                         ::testing::Values(LoopKind::revolute, LoopKind::point_on_line),
                         [](const auto& info) { return std::string(loop_kind_name(info.param)); });

// Atwood's machine: a = g (m1 - m2)/(m1 + m2), tension 2 m1 m2 g/(m1 + m2).
TEST(RopeLength, AtwoodsMachine) {
  constexpr double g = 9.80665;
  MechanismBuilder builder;
  for (const auto& [name, x, mass] :
       {std::tuple("left", -1.0, 5.0), std::tuple("right", 1.0, 3.0)}) {
    BodyDefinition body;
    body.name = name;
    body.joint = {JointKind::prismatic, Vector3::UnitZ()};
    body.X_PJ = Pose::translation({x, 0, 0});
    body.mass = mass;
    builder.add_body(body);
  }
  LoopDefinition rope;
  rope.name = "rope";
  rope.kind = LoopKind::rope_length;
  rope.paths = {{{"left", Vector3::Zero()},
                 {"world", {-1, 0, 9}},
                 {"world", {1, 0, 9}},
                 {"right", Vector3::Zero()}}};
  builder.add_loop(rope);
  const Mechanism m = builder.build().with_loops_as_at(Eigen::Vector2d(0, 0));
  const Solution found(m, Eigen::Vector2d(0, 0), Eigen::Vector2d(1, -1));
  EXPECT_NEAR(found.vdot[0], -g * 2 / 8, 1e-13);
  EXPECT_NEAR(found.vdot[1], g * 2 / 8, 1e-13);
  EXPECT_NEAR(found.w.lambda[0], -2 * 15 * g / 8, 1e-12);
  const ForceVector F = loop_force(m, found.kinematics, found.w.loops, 0, found.w.lambda);
  EXPECT_NEAR(F.force.z(), 2 * 15 * g / 8, 1e-12);
}

// Two wheels: (I1 + I2/r^2) w1' = M, w1 = r w2; the tooth moment on the first is M - I1 w1'.
TEST(Gear, TwoWheels) {
  MechanismBuilder builder;
  for (const auto& [name, inertia] : {std::pair("first", 2.0), std::pair("second", 0.3)}) {
    BodyDefinition body;
    body.name = name;
    body.joint = {JointKind::revolute, Vector3::UnitX()};
    body.mass = 1;
    body.I_BBcm_B = Vector3(inertia, inertia, inertia).asDiagonal();
    builder.add_body(body);
  }
  LoopDefinition gear;
  gear.name = "gear";
  gear.kind = LoopKind::gear;
  gear.first = "first";
  gear.second = "second";
  gear.ratio = -0.5;
  builder.add_loop(gear);
  const Mechanism m = builder.build();
  const Solution found(m, Eigen::Vector2d(0.3, 0.1), Eigen::Vector2d(1, -2), examples::no_forces(m),
                       Eigen::Vector2d(7, 0), Eigen::Vector2d(0, 0));
  const double rate = 7 / (2.0 + 0.3 / 0.25);
  EXPECT_NEAR(found.vdot[0], rate, 1e-13);
  EXPECT_NEAR(found.vdot[1], -2 * rate, 1e-13);
  EXPECT_NEAR(found.w.lambda[0], 2.0 * rate - 7, 1e-13);
}

// A rod between a fixed point and a particle is a pendulum: angular acceleration -(g/L) sin, and
// its tension m (g cos + L w^2).
TEST(Distance, IsAPendulum) {
  constexpr double g = 9.80665, length = 2.5, angle = 0.7, w = 1.3, mass = 4;
  MechanismBuilder builder;
  BodyDefinition body;
  body.name = "particle";
  body.joint.kind = JointKind::translational;
  body.mass = mass;
  builder.add_body(body);
  LoopDefinition rod;
  rod.name = "rod";
  rod.kind = LoopKind::distance;
  rod.second = "particle";
  rod.length = length;
  builder.add_loop(rod);
  const Mechanism m = builder.build();
  const Vector3 along(std::sin(angle), 0, -std::cos(angle));
  const Vector3 across(std::cos(angle), 0, std::sin(angle));
  const Solution found(m, length * along, length * w * across);
  const Vector3 wanted = -g * std::sin(angle) * across - length * w * w * along;
  EXPECT_LT((found.vdot - wanted).norm(), 1e-13);
  EXPECT_NEAR(found.w.lambda[0], -mass * (g * std::cos(angle) + length * w * w), 1e-12);
}

// A bead on a straight wire slides like a body on a prismatic joint.
TEST(PointOnLine, IsABeadOnAWire) {
  MechanismBuilder builder;
  BodyDefinition body;
  body.name = "bead";
  body.joint.kind = JointKind::translational;
  body.mass = 2;
  builder.add_body(body);
  LoopDefinition wire;
  wire.name = "wire";
  wire.kind = LoopKind::point_on_line;
  wire.first = "bead";
  wire.X_SecondK.p = Vector3(0, 0, 1);
  wire.axis = Vector3(3, 0, 4);
  builder.add_loop(wire);
  const Mechanism m = builder.build();
  const Vector3 u(0.6, 0, 0.8);
  const Solution found(m, Vector3(0, 0, 1) + 2 * u, 3 * u);
  EXPECT_LT(found.w.loops.residual.norm(), 1e-15);
  EXPECT_LT((found.vdot - m.gravity().dot(u) * u).norm(), 1e-14);
  // The second body is the world: the force on it is the bead's weight across the wire.
  const ForceVector F = loop_force(m, found.kinematics, found.w.loops, 0, found.w.lambda);
  const Vector3 weight = 2 * m.gravity();
  EXPECT_LT((F.force - (weight - weight.dot(u) * u)).norm(), 1e-13);
}

// One equation of Bricard's loop repeats the others: accelerations are unique, and the multipliers
// are the least of all that balance them.
TEST(Redundancy, BricardHasLeastMultipliers) {
  const Mechanism m = test::bricard_linkage();
  Eigen::VectorXd q = m.zero_configuration();
  Eigen::VectorXd v = Eigen::VectorXd::Zero(5);
  v[0] = 1;
  assemble(m, q, v);
  EXPECT_GT(v.norm(), 0.1);
  const Solution found(m, q, v);
  EXPECT_EQ(found.w.rank, 4);
  const Eigen::MatrixXd G = calc_loop_jacobian(m, found.kinematics, found.w.loops);
  // M vdot + h = G^T lambda by inverse dynamics.
  InverseDynamicsWorkspace inverse(m);
  Eigen::VectorXd needed(5);
  compute_inverse_dynamics(m, found.kinematics, v, found.vdot, examples::no_forces(m), inverse,
                           needed);
  EXPECT_LT((needed - G.transpose() * found.w.lambda).norm(), 1e-11);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(1e-9);
  decomposition.compute(G.transpose());
  const Eigen::VectorXd least = decomposition.solve(needed);
  EXPECT_LT((found.w.lambda - least).norm(), 1e-11 * (1 + least.norm()));
  std::vector<MotionVector> A_WB(6);
  compute_accelerations(m, found.kinematics, found.vdot, A_WB);
  Eigen::VectorXd accelerations(5);
  calc_loop_accelerations(m, found.kinematics, found.w.loops, found.vdot, A_WB, accelerations);
  EXPECT_LT(accelerations.norm(), 1e-11);
}

// Folded flat a parallelogram's Jacobian loses a row: accelerations stay finite.
TEST(Redundancy, TogglePositionIsFinite) {
  const Mechanism m = test::four_bar(1, 1, 1, 1);
  Eigen::Vector3d q(0, M_PI, -M_PI);  // crank out, coupler back, rocker out
  ASSERT_NO_THROW(assemble(m, q));
  const Solution found(m, q, Eigen::Vector3d::Zero());
  EXPECT_TRUE(found.vdot.allFinite());
  EXPECT_TRUE(found.w.lambda.allFinite());
  EXPECT_EQ(found.w.rank, 1);
}

TEST(ConstrainedDynamics, NamesWhatNothingResists) {
  MechanismBuilder builder;
  BodyDefinition body;
  body.name = "point";
  body.joint.kind = JointKind::free;
  body.mass = 1;
  builder.add_body(body);
  LoopDefinition rod;
  rod.name = "rod";
  rod.kind = LoopKind::distance;
  rod.second = "point";
  builder.add_loop(rod);
  const Mechanism m = builder.build();
  Eigen::VectorXd q = m.zero_configuration();
  q[0] = 1;
  try {
    const Solution found(m, q, Eigen::VectorXd::Zero(6));
    FAIL() << "a point's spin has no inertia";
  } catch (const SimulationError& error) {
    EXPECT_NE(std::string(error.what()).find("body \"point\" (free"), std::string::npos);
  }
}

}  // namespace
}  // namespace blocklift::dynamics
