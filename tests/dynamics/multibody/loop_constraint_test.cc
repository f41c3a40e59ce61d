// Definitions of loops and what is wrong with them; residuals, Jacobian and velocity terms against
// finite differences, for every kind.
#include "dynamics/multibody/loop_constraint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using ::testing::HasSubstr;

MechanismBuilder three_bodies() {
  Random random(3);
  MechanismBuilder builder;
  builder.add_body(examples::random_body(random, JointKind::revolute, "crank", "world"));
  builder.add_body(examples::random_body(random, JointKind::cylindrical, "rod", "crank"));
  builder.add_body(examples::random_body(random, JointKind::fixed, "plate", "rod"));
  builder.add_body(examples::random_body(random, JointKind::free, "block", "world"));
  return builder;
}

LoopDefinition hinge() {
  LoopDefinition loop;
  loop.name = "hinge";
  loop.first = "rod";
  loop.second = "block";
  return loop;
}

template <class Change>
std::string message_after(Change change) {
  MechanismBuilder builder = three_bodies();
  LoopDefinition loop = hinge();
  change(loop);
  try {
    builder.add_loop(loop);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(LoopDefinition, TellsWhatIsWrong) {
  EXPECT_EQ(message_after([](auto&) {}), "");
  EXPECT_THAT(message_after([](auto& l) { l.name = ""; }), HasSubstr("a loop has no name"));
  EXPECT_THAT(message_after([](auto& l) { l.first = "rode"; }),
              HasSubstr("loop \"hinge\": its body \"rode\" is not there; bodies come before loops, "
                        "and so far there are: world, crank, rod, plate, block"));
  EXPECT_THAT(message_after([](auto& l) { l.second = "rod"; }), HasSubstr("both its bodies are"));
  EXPECT_THAT(message_after([](auto& l) { l.second = "plate"; }),
              HasSubstr("\"rod\" and \"plate\" are fixed to each other"));
  EXPECT_THAT(message_after([](auto& l) { l.axis.setZero(); }), HasSubstr("has no direction"));
  EXPECT_THAT(message_after([](auto& l) { l.X_FirstK.R *= 2; }), HasSubstr("not a rotation"));
  EXPECT_THAT(message_after([](auto& l) { l.X_SecondK.p[0] = not_a_number; }),
              HasSubstr("frame in the second body is not finite"));
  EXPECT_THAT(message_after([](auto& l) { l.length = 2; }),
              HasSubstr("a revolute loop has no length; only distance and rope_length take one"));
  EXPECT_THAT(message_after([](auto& l) { l.second_axis = Vector3::UnitX(); }),
              HasSubstr("has no second axis"));
  EXPECT_THAT(message_after([](auto& l) {
                l.kind = LoopKind::universal;
                l.second_axis = Vector3(0, 1, 1);
              }),
              HasSubstr("enclose 45 degrees; 90 are due"));
  EXPECT_THAT(message_after([](auto& l) {
                l.kind = LoopKind::distance;
                l.length = -1;
              }),
              HasSubstr("the length of its rod is -1 m"));
  EXPECT_THAT(message_after([](auto& l) {
                l.kind = LoopKind::distance;
                l.axis = Vector3::UnitX();
              }),
              HasSubstr("a distance loop has no axis"));
}

TEST(LoopDefinition, TellsWhatIsWrongWithGearsAndRopes) {
  const auto gear = [](auto change) {
    return message_after([&](auto& l) {
      l.kind = LoopKind::gear;
      l.first = "crank";
      l.second = "rod";
      l.ratio = 2;
      change(l);
    });
  };
  EXPECT_EQ(gear([](auto&) {}), "");
  EXPECT_THAT(gear([](auto& l) { l.ratio = 0; }), HasSubstr("its ratio is 0"));
  EXPECT_THAT(gear([](auto& l) { l.first = "plate"; }), HasSubstr("does not move"));
  EXPECT_THAT(gear([](auto& l) { l.second = "block"; }),
              HasSubstr("is free and has no coordinate"));
  EXPECT_THAT(gear([](auto& l) { l.first_velocity = 1; }),
              HasSubstr("has 1 velocity and no number 1"));
  EXPECT_THAT(gear([](auto& l) { l.first = "rod"; }), HasSubstr("gears a joint with itself"));
  EXPECT_THAT(gear([](auto& l) { l.X_FirstK.p[0] = 1; }), HasSubstr("has no frame in its bodies"));
  const auto rope = [](auto change) {
    return message_after([&](auto& l) {
      l = LoopDefinition{};
      l.name = "hinge";
      l.kind = LoopKind::rope_length;
      l.paths = {{{"world", Vector3(0, 0, 1)}, {"block", Vector3::Zero()}}};
      change(l);
    });
  };
  EXPECT_EQ(rope([](auto&) {}), "");
  EXPECT_THAT(rope([](auto& l) { l.paths.clear(); }), HasSubstr("it has no path"));
  EXPECT_THAT(rope([](auto& l) { l.paths[0].pop_back(); }), HasSubstr("a path has 1 point(s)"));
  EXPECT_THAT(rope([](auto& l) { l.paths[0][1].body = "world"; }), HasSubstr("never changes"));
  EXPECT_THAT(rope([](auto& l) { l.first = "rod"; }), HasSubstr("no first and second body"));
  EXPECT_THAT(rope([](auto& l) { l.length = 0; }), HasSubstr("the length of its rope is 0"));
}

TEST(LoopDefinition, NamesMustDifferAndRowsHaveNames) {
  MechanismBuilder builder = three_bodies();
  LoopDefinition loop = hinge();
  loop.axis = Vector3(0, 3, 0);
  EXPECT_EQ(builder.add_loop(loop), 0);
  EXPECT_THROW(builder.add_loop(loop), ModelError);
  loop.name = "guide";
  loop.kind = LoopKind::prismatic;
  EXPECT_EQ(builder.add_loop(loop), 1);
  const Mechanism mechanism = builder.build();
  EXPECT_EQ(mechanism.loop_row_count(), 10);
  EXPECT_EQ(mechanism.loop_index("guide"), 1);
  EXPECT_THROW(mechanism.loop_index("guise"), ModelError);
  EXPECT_EQ(mechanism.loop_row_name(3), "loop \"hinge\", rotation about z");
  EXPECT_EQ(mechanism.loop_row_name(4), "loop \"hinge\", rotation about x");
  EXPECT_EQ(mechanism.loop_row_name(5), "loop \"guide\", displacement along z");
  EXPECT_TRUE(mechanism.loop_row_is_angle(3));
  EXPECT_FALSE(mechanism.loop_row_is_angle(2));
  for (const std::string_view name : loop_kind_names()) {
    EXPECT_EQ(loop_kind_name(loop_kind(name).value()), name);
  }
  EXPECT_FALSE(loop_kind("hinge").has_value());
}

// A random mechanism with a loop of the kind in a random state, which does not close it.
struct LoopOfKind {
  LoopOfKind(LoopKind kind, unsigned seed)
      : random(seed),
        mechanism(test::random_mechanism_with_loop(random, kind)),
        q(mechanism.nq()),
        v(random.values(mechanism.nv(), 1)) {
    q = examples::random_configuration(random, mechanism);
  }

  LoopState state_at(const Eigen::VectorXd& where, const Eigen::VectorXd& velocity) const {
    Kinematics kinematics(mechanism);
    LoopState state(mechanism);
    compute_kinematics(mechanism, where, velocity, kinematics);
    compute_loops(mechanism, kinematics, where, velocity, state);
    return state;
  }

  Eigen::VectorXd moved(double s) const {
    Eigen::VectorXd result(mechanism.nq());
    mechanism.integrate(q, v, s, result);
    return result;
  }

  Random random;
  Mechanism mechanism;
  Eigen::VectorXd q, v;
};

class EveryLoopKind : public ::testing::TestWithParam<LoopKind> {};

// Central differences with the step h = 1e-5: error h^2 / 6 times third derivatives (of size 10 to
// 100 at these velocities and distances) + rounding / h = 1e-9.
constexpr double h = 1e-5;
constexpr double difference_error = 1e-8;

TEST_P(EveryLoopKind, ResidualHasTheJacobianOnTheConstraint) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    LoopOfKind sample(GetParam(), seed);
    assemble(sample.mechanism, sample.q);
    EXPECT_LT(sample.state_at(sample.q, sample.v).residual.lpNorm<Eigen::Infinity>(), 1e-12);
    Kinematics kinematics(sample.mechanism);
    compute_kinematics(sample.mechanism, sample.q, sample.v, kinematics);
    const LoopState state = sample.state_at(sample.q, sample.v);
    const Eigen::MatrixXd G = calc_loop_jacobian(sample.mechanism, kinematics, state);
    const Eigen::VectorXd rate = (sample.state_at(sample.moved(h), sample.v).residual -
                                  sample.state_at(sample.moved(-h), sample.v).residual) /
                                 (2 * h);
    EXPECT_LT((G * sample.v - rate).norm(), difference_error);
    EXPECT_LT((G * sample.v - state.velocity).norm(), 1e-13);
  }
}

TEST_P(EveryLoopKind, VelocityHasTheRateThatIsComputed) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const LoopOfKind sample(GetParam(), seed);
    Kinematics kinematics(sample.mechanism);
    compute_kinematics(sample.mechanism, sample.q, sample.v, kinematics);
    const LoopState state = sample.state_at(sample.q, sample.v);
    // q (+) s v has constant v: vdot is zero.
    const Eigen::VectorXd vdot = Eigen::VectorXd::Zero(sample.mechanism.nv());
    std::vector<MotionVector> A_WB(static_cast<std::size_t>(sample.mechanism.body_count()));
    compute_accelerations(sample.mechanism, kinematics, vdot, A_WB);
    Eigen::VectorXd accelerations(sample.mechanism.loop_row_count());
    calc_loop_accelerations(sample.mechanism, kinematics, state, vdot, A_WB, accelerations);
    const Eigen::VectorXd rate = (sample.state_at(sample.moved(h), sample.v).velocity -
                                  sample.state_at(sample.moved(-h), sample.v).velocity) /
                                 (2 * h);
    EXPECT_LT((accelerations - rate).norm(), 10 * difference_error * (1 + rate.norm()));
  }
}

// Power of the forces equals lambda . G v, and the forces on both bodies are in balance.
TEST_P(EveryLoopKind, ForcesAreTheTransposedJacobian) {
  LoopOfKind sample(GetParam(), 11);
  const Mechanism& m = sample.mechanism;
  Kinematics kinematics(m);
  compute_kinematics(m, sample.q, sample.v, kinematics);
  const LoopState state = sample.state_at(sample.q, sample.v);
  const Eigen::VectorXd lambda = sample.random.values(m.loop_row_count(), 1);
  std::vector<ForceVector> F_Bo_W = examples::no_forces(m);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(m.nv());
  add_loop_forces(m, kinematics, state, lambda, F_Bo_W, tau);
  double power = tau.dot(sample.v);
  ForceVector sum = ForceVector::zero();
  for (std::size_t i = 0; i < F_Bo_W.size(); ++i) {
    power += dot(F_Bo_W[i], kinematics.V_WB[i]);
    sum += shift_to(F_Bo_W[i], kinematics.X_WB[i].p);
  }
  EXPECT_NEAR(power, lambda.dot(state.velocity), 1e-12);
  EXPECT_LT(sum.moment.norm() + sum.force.norm(), 1e-12);
  // The output is what acts on the second body.
  const Loop& loop = m.loops()[0];
  if (loop.follower < 0) return;
  const ForceVector F = loop_force(m, kinematics, state, 0, lambda);
  const Vector3 p = loop.second == loop.follower ? loop.X_FollowerK.p : loop.X_BaseK.p;
  const auto second = static_cast<std::size_t>(loop.second);
  const ForceVector about_origin = shift_to(F, kinematics.X_WB[second].R * p);
  EXPECT_LT((about_origin.moment - F_Bo_W[second].moment).norm(), 1e-13);
  EXPECT_LT((about_origin.force - F_Bo_W[second].force).norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(All, EveryLoopKind,
                         ::testing::Values(LoopKind::fixed, LoopKind::revolute, LoopKind::prismatic,
                                           LoopKind::cylindrical, LoopKind::universal,
                                           LoopKind::spherical, LoopKind::planar,
                                           LoopKind::translational, LoopKind::distance,
                                           LoopKind::point_on_line, LoopKind::gear,
                                           LoopKind::rope_length),
                         [](const auto& info) { return std::string(loop_kind_name(info.param)); });

TEST(LoopConstraint, OpenLengthsAreTakenFromTheStart) {
  MechanismBuilder builder = three_bodies();
  LoopDefinition rod;
  rod.name = "rod";
  rod.kind = LoopKind::distance;
  rod.second = "block";
  builder.add_loop(rod);
  LoopDefinition gear;
  gear.name = "gear";
  gear.kind = LoopKind::gear;
  gear.first = "crank";
  gear.second = "rod";
  gear.ratio = 3;
  builder.add_loop(gear);
  const Mechanism open = builder.build();
  EXPECT_TRUE(std::isnan(open.loops()[0].length));
  Random random(5);
  const Eigen::VectorXd q = examples::random_configuration(random, open);
  const Mechanism mechanism = open.with_loops_as_at(q);
  Kinematics kinematics(mechanism);
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(mechanism.nv());
  compute_kinematics(mechanism, q, v, kinematics);
  EXPECT_NEAR(mechanism.loops()[0].length, kinematics.X_WB[4].p.norm(), 1e-14);
  EXPECT_TRUE(std::isnan(mechanism.loops()[0].offset));
  EXPECT_NEAR(mechanism.loops()[1].offset, q[0] - 3 * q[1], 1e-14);
  EXPECT_TRUE(std::isnan(mechanism.loops()[1].length));
}

}  // namespace
}  // namespace blocklift::dynamics
