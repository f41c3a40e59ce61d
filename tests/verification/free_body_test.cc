// The recursive kernel against an independent formulation: free bodies, all joints and loops as
// equations
// (Gear, Gupta and Leimkuhler 1985), IDA. Both share the mechanism's data and no algorithm.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/multibody/assembly.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/verification/free_body_integration.h"

namespace blocklift {
namespace {

using dynamics::BodyDefinition;
using dynamics::JointKind;
using dynamics::LoopDefinition;
using dynamics::LoopKind;
using dynamics::Mechanism;
using dynamics::MechanismBuilder;
using dynamics::Pose;
using dynamics::Vector3;
using dynamics::Vector4;

/// Slender rod of length l (m) from its origin along y, a square of 0.1 m across.
BodyDefinition rod(const std::string& name, const std::string& parent, double mass, double l) {
  BodyDefinition body;
  body.name = name;
  body.parent = parent;
  body.mass = mass;
  body.p_BoBcm_B = Vector3(0, l / 2, 0);
  const double across = mass * (l * l + 0.01) / 12;
  body.I_BBcm_B = Vector3(across, mass * 0.02 / 12, across).asDiagonal();
  return body;
}

free_bodies::State state_of(const Mechanism& mechanism, const dynamics::History& history,
                            Eigen::Index sample) {
  free_bodies::State state;
  for (int i = 1; i < mechanism.body_count(); ++i) {
    const dynamics::BodyHistory& body = history.bodies[i - 1];
    const Pose X_WB = body.X_WB(sample);
    const Vector3 p_BoBcm_W = X_WB.R * mechanism.body(i).inertia.p_BoBcm;
    const dynamics::MotionVector V = body.V_WB(sample);
    state.p_WBcm.emplace_back(X_WB.p + p_BoBcm_W);
    state.Q_WB.emplace_back(body.pose.row(sample).tail<4>());
    state.v_WBcm.emplace_back(V.linear + V.angular.cross(p_BoBcm_W));
    state.w_WB_B.emplace_back(X_WB.R.transpose() * V.angular);
  }
  return state;
}

struct Difference {
  double position = 0;     ///< of centres of mass, m
  double orientation = 0;  ///< rad
  double velocity = 0;     ///< m/s and rad/s
};

Difference largest_difference(const free_bodies::State& a, const free_bodies::State& b) {
  Difference largest;
  for (std::size_t i = 0; i < a.p_WBcm.size(); ++i) {
    const Vector4& Qa = a.Q_WB[i];
    const Vector4 Qb = b.Q_WB[i] * (Qa.dot(b.Q_WB[i]) < 0 ? -1.0 : 1.0);
    largest.position = std::max(largest.position, (a.p_WBcm[i] - b.p_WBcm[i]).norm());
    largest.orientation = std::max(largest.orientation, 2 * (Qa - Qb).norm());
    largest.velocity = std::max(
        {largest.velocity, (a.v_WBcm[i] - b.v_WBcm[i]).norm(), (a.w_WB_B[i] - b.w_WB_B[i]).norm()});
  }
  return largest;
}

/// Integrates both ways for `duration` s and returns the largest difference at its tenths.
Difference compare(const Mechanism& mechanism, const std::vector<LoopDefinition>& loops,
                   Eigen::VectorXd q, Eigen::VectorXd v, double duration) {
  dynamics::assemble(mechanism, q, v);
  dynamics::OperationBuilder operation;
  operation.add_stage("run", 0, duration);
  const dynamics::LiftSystem system(
      {.mechanism = mechanism, .operation = operation.build(duration), .q_start = q, .v_start = v});
  const dynamics::History kernel =
      dynamics::integrate(system, q, v,
                          {.relative_tolerance = 1e-13, .sample_interval = duration / 10})
          .history;

  const free_bodies::State start = state_of(mechanism, kernel, 0);
  // The start that the kernel found fulfils the other formulation's equations: poses and velocities
  // of the joints, and the assembly of the loops, agree.
  const auto rows = free_bodies::make_rows(mechanism, loops);
  EXPECT_LT(free_bodies::calc_residual(rows, start).lpNorm<Eigen::Infinity>(), 1e-11);

  const std::vector<double> times(kernel.time.begin(), kernel.time.end());
  const auto others = free_bodies::integrate(mechanism, loops, start, times, 1e-12);
  Difference largest;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Difference difference =
        largest_difference(state_of(mechanism, kernel, static_cast<Eigen::Index>(i)), others[i]);
    largest.position = std::max(largest.position, difference.position);
    largest.orientation = std::max(largest.orientation, difference.orientation);
    largest.velocity = std::max(largest.velocity, difference.velocity);
  }
  return largest;
}

void expect_agreement(const Difference& difference, double tolerance) {
  EXPECT_LT(difference.position, tolerance);
  EXPECT_LT(difference.orientation, tolerance);
  EXPECT_LT(difference.velocity, 10 * tolerance);
}

// The paper's first test mechanism (Ku, Ha, Roh, Fig. 3): crank, rod and a body led square to x by
// a cylindrical joint; the paper gives no dimensions. Two of the loop's equations repeat others:
// all motion is in the plane of y and z.
TEST(FreeBodies, ThreeBodiesWithRevoluteJointsAndACylindricalLoop) {
  MechanismBuilder builder;
  const dynamics::Joint hinge{JointKind::revolute, Vector3::UnitX()};
  BodyDefinition crank = rod("crank", "world", 2, 0.5);
  crank.joint = hinge;
  builder.add_body(crank);
  BodyDefinition link = rod("rod", "crank", 3, 1.2);
  link.joint = hinge;
  link.X_PJ = Pose::translation({0, 0.5, 0});
  builder.add_body(link);
  BodyDefinition slider = rod("slider", "rod", 4, 0.3);
  slider.joint = hinge;
  slider.X_PJ = Pose::translation({0, 1.2, 0});
  builder.add_body(slider);
  LoopDefinition guide;
  guide.name = "guide";
  guide.kind = LoopKind::cylindrical;
  guide.second = "slider";
  guide.axis = Vector3::UnitY();
  builder.add_loop(guide);
  const Mechanism mechanism = builder.build();

  const double crank_angle = std::numbers::pi / 3;
  const double rod_angle = -crank_angle - std::asin(0.5 * std::sin(crank_angle) / 1.2);
  const Eigen::VectorXd q = Vector3(crank_angle, rod_angle, -crank_angle - rod_angle);
  expect_agreement(compare(mechanism, {guide}, q, Eigen::VectorXd::Unit(3, 0), 5), 1e-8);
}

TEST(FreeBodies, TreeOfAllJointKinds) {
  dynamics::examples::Random random(7);
  MechanismBuilder builder;
  std::string parent = "world";
  for (const JointKind kind : {JointKind::revolute, JointKind::universal, JointKind::spherical,
                               JointKind::cylindrical, JointKind::planar, JointKind::prismatic,
                               JointKind::translational, JointKind::free, JointKind::fixed}) {
    const std::string name(dynamics::joint_kind_name(kind));
    builder.add_body(dynamics::examples::random_body(random, kind, name, parent));
    parent = kind == JointKind::cylindrical ? "universal" : name;
  }
  const Mechanism mechanism = builder.build();
  const Eigen::VectorXd q = dynamics::examples::random_configuration(random, mechanism);
  expect_agreement(compare(mechanism, {}, q, random.values(mechanism.nv(), 0.5), 1), 1e-8);
}

// Rods hung up in every way that is no joint: a rigid rod, a point on a line, a rope of given
// length over three points.
TEST(FreeBodies, RodPointOnLineAndRope) {
  MechanismBuilder builder;
  const std::vector<std::string> names = {"a", "b", "c"};
  Eigen::VectorXd q(0);
  for (std::size_t i = 0; i < names.size(); ++i) {
    BodyDefinition body = rod(names[i], "world", 2 + static_cast<double>(i), 1);
    body.joint = {JointKind::free};
    builder.add_body(body);
    q.conservativeResize(q.size() + 7);
    q.tail<7>() << 0.1 * static_cast<double>(i), 0.2, -2.0 * static_cast<double>(i) - 1, 1, 0, 0, 0;
  }
  std::vector<LoopDefinition> loops(4);
  loops[0] = {.name = "rod", .kind = LoopKind::distance, .second = "a", .length = 1.1};
  loops[1] = {.name = "rail", .kind = LoopKind::point_on_line, .first = "a", .second = "world"};
  loops[1].X_FirstK = Pose::translation({0, 1, 0});
  loops[1].X_SecondK = Pose::translation({0, 1.2, -1});
  loops[1].axis = Vector3(0.2, 1, 0.3);
  loops[2] = {.name = "rope", .kind = LoopKind::rope_length, .length = 4.5};
  loops[2].paths = {{{"a", {0, 1, 0}}, {"b", {0, 0.2, 0}}, {"c", {0, 0.5, 0}}}};
  loops[3] = {.name = "hinge", .kind = LoopKind::universal, .first = "b", .second = "c"};
  loops[3].X_FirstK = Pose::translation({0.1, 1, -1});
  loops[3].axis = Vector3::UnitX();
  loops[3].second_axis = Vector3::UnitY();
  for (const LoopDefinition& loop : loops) builder.add_loop(loop);
  const Mechanism mechanism = builder.build();
  expect_agreement(compare(mechanism, loops, q, Eigen::VectorXd::Constant(mechanism.nv(), 0.1), 1),
                   1e-8);
}

}  // namespace
}  // namespace blocklift
