// The Jacobian of the whole right-hand side against central differences: random trees with every
// kind of joint, driven ones among them, ropes straight and over sheaves, springs, pads that stick
// and that slide, wind on flat and on round areas, moving fast.
#include "dynamics/simulation/jacobian.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/simulation/newton_matrix.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;

BodyPoint random_point(Random& random, const Mechanism& mechanism) {
  return {random.integer(0, mechanism.body_count() - 1), random.vector(1.5)};
}

std::vector<Rope> random_ropes(Random& random, const Mechanism& mechanism) {
  std::vector<Rope> ropes;
  for (std::size_t points : {2, 2, 3, 5, 4}) {
    RopeDefinition rope;
    rope.name = "rope " + std::to_string(ropes.size());
    for (std::size_t i = 0; i < points; ++i) rope.points.push_back(random_point(random, mechanism));
    if (points == 5) rope.left_out = {0, 0, 1, 0};
    if (points == 4) rope.left_out = {0, 1, 0};
    rope.twin_falls = points == 4;
    rope.axial_stiffness = random.uniform(20, 60);
    rope.crane_stiffness = 100;
    rope.damping_time = 0.1;
    rope.damping = 0.5;
    rope.unstretched_length = 0.5;
    ropes.emplace_back(mechanism, rope);
  }
  return ropes;
}

// Pads whose friction holds (a high limit) and gives way (a low one).
std::vector<SupportPad> random_pads(Random& random, const Mechanism& mechanism) {
  std::vector<SupportPad> pads;
  for (const double friction : {50.0, 0.3}) {
    pads.emplace_back(SupportPad::Definition{.name = "pad " + std::to_string(pads.size()),
                                             .point = random_point(random, mechanism),
                                             .p_WG = random.vector(1) + Vector3(0, 0, 8),
                                             .stiffness = 20,
                                             .damping = 1,
                                             .friction_coefficient = friction,
                                             .tangential_stiffness = 10,
                                             .tangential_damping = 2});
  }
  return pads;
}

// Neither of its matrices is symmetric.
LinearRestraint::Definition random_restraint(Random& random) {
  LinearRestraint::Definition restraint{
      .name = "restraint", .point = {1, random.vector(1)}, .X_WR = random.pose(1)};
  for (int column = 0; column < 6; ++column) {
    restraint.stiffness.col(column) = random.values(6, 10);
    restraint.damping.col(column) = random.values(6, 1);
  }
  restraint.damping += 6.0 * LinearRestraint::Matrix6::Identity();
  return restraint;
}

ForceElements random_elements(Random& random, const Mechanism& mechanism) {
  ForceElements elements;
  const auto spring = [&](const std::string& name) {
    BodyPoint from = random_point(random, mechanism);
    from.body = 1 + from.body % (mechanism.body_count() - 1);
    return PointSpring::Definition{.name = name,
                                   .from = from,
                                   .to = {world_index, random.vector(3)},
                                   .stiffness = random.uniform(5, 20),
                                   .damping = random.uniform(0, 3),
                                   .free_length = random.uniform(0.5, 3)};
  };
  for (const char* name : {"a", "b", "c"}) {
    std::get<std::vector<PointSpring>>(elements).emplace_back(spring(name));
  }
  for (const BodyIndex from : {world_index, mechanism.body_count() / 2}) {
    std::get<std::vector<TorsionalSpring>>(elements).emplace_back(
        TorsionalSpring::Definition{.name = "torsional",
                                    .from = from,
                                    .to = mechanism.body_count() - 1,
                                    .stiffness = random.uniform(5, 20),
                                    .damping = random.uniform(0, 3),
                                    .R_FT_free = random.pose(1).R});
  }
  std::get<std::vector<LinearRestraint>>(elements).emplace_back(random_restraint(random));
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    const Body& body = mechanism.body(i);
    if (body.nv() == 0) continue;
    std::get<std::vector<JointLoad>>(elements).emplace_back(
        mechanism, JointLoad::Definition{.name = "load " + std::to_string(i),
                                         .body = i,
                                         .degree_of_freedom = body.nv() - 1,
                                         .load = LoadTable(random.vector(3))});
    if (!velocities_are_rates(body.joint.kind)) continue;
    std::get<std::vector<JointSpring>>(elements).emplace_back(
        mechanism, JointSpring::Definition{.name = "joint " + std::to_string(i),
                                           .body = i,
                                           .degree_of_freedom = body.nv() - 1,
                                           .stiffness = random.uniform(5, 20),
                                           .damping = 1,
                                           .free_coordinate = 0.3});
    std::get<std::vector<JointFriction>>(elements).emplace_back(
        mechanism, JointFriction::Definition{.name = "friction " + std::to_string(i),
                                             .body = i,
                                             .degree_of_freedom = body.nv() - 1,
                                             .friction = random.uniform(1, 3),
                                             .creep = 0.7});
  }
  for (const auto axes : {AppliedLoad::Axes::world, AppliedLoad::Axes::body}) {
    BodyPoint point = random_point(random, mechanism);
    point.body = 1 + point.body % (mechanism.body_count() - 1);
    std::get<std::vector<AppliedLoad>>(elements).emplace_back(
        AppliedLoad::Definition{.name = "applied",
                                .point = point,
                                .axes = axes,
                                .force = LoadTable(random.vector(10)),
                                .moment = LoadTable(random.vector(10))});
  }
  const Wind wind = Wind::level(8, 0.4);
  for (const bool flat : {false, true}) {
    WindArea::Definition area{.name = flat ? "flat" : "round",
                              .centre_of_pressure = random_point(random, mechanism),
                              .area = 2,
                              .coefficient = 1.2,
                              .normal_B = {}};
    if (flat) area.normal_B = random.direction();
    std::get<std::vector<WindArea>>(elements).emplace_back(wind, area);
  }
  return elements;
}

LiftSystem random_system(Random& random) {
  Mechanism mechanism = examples::random_tree(random, 11, true);
  std::vector<Rope> ropes = random_ropes(random, mechanism);
  std::vector<SupportPad> pads = random_pads(random, mechanism);
  ForceElements elements = random_elements(random, mechanism);
  OperationBuilder operation;
  const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const Operation built = operation.build(1.0);
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = std::move(pads),
                     .elements = std::move(elements),
                     .operation = built,
                     .q_start = q,
                     .v_start = {}});
}

LiftSystem alone(Mechanism mechanism, Random& random) {
  OperationBuilder operation;
  const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const Operation built = operation.build(1.0);
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = {},
                     .supports = {},
                     .elements = {},
                     .operation = built,
                     .q_start = q,
                     .v_start = {}});
}

double error(const Eigen::MatrixXd& a, const Eigen::MatrixXd& reference) {
  return (a - reference).lpNorm<Eigen::Infinity>() / reference.lpNorm<Eigen::Infinity>();
}

class Jacobian : public ::testing::TestWithParam<unsigned> {
 protected:
  Jacobian() : random_(GetParam()), system_(random_system(random_)), w_(system_) {
    // Quaternions off unit length too, as an integrator's trial states are.
    y_.resize(system_.state_size());
    get_state(system_, system_.q_start() * 1.05, random_.values(system_.mechanism().nv(), 1), y_);
    for (const int k : system_.mechanism().driven_velocities()) w_.v[k] = random_.uniform(-1, 1);
    contacts_.assign(system_.contact_count(), 1);
  }

  Eigen::MatrixXd analytical() {
    JacobianWorkspace workspace(system_);
    Eigen::MatrixXd J(system_.state_size(), system_.state_size());
    calc_jacobian(system_, 0.0, y_, &contacts_, w_, workspace, J);
    return J;
  }

  Random random_;
  LiftSystem system_;
  LiftWorkspace w_;
  Eigen::VectorXd y_;
  Contacts contacts_;
};

TEST_P(Jacobian, IsThatOfDifferences) {
  const Eigen::MatrixXd J = analytical();
  EXPECT_LT(error(difference_jacobian(system_, 0.0, y_, &contacts_, w_, 1e-5), J), 1e-7);
}

TEST_P(Jacobian, DifferencesApproachItInSecondOrder) {
  const Eigen::MatrixXd J = analytical();
  const auto at = [&](double h) {
    return error(difference_jacobian(system_, 0.0, y_, &contacts_, w_, h), J);
  };
  const double coarse = at(4e-4);
  const double fine = at(2e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

// The structured solution equals the whole matrix's.
TEST_P(Jacobian, NewtonMatrixSolvesWithIt) {
  const Eigen::MatrixXd J = analytical();
  NewtonMatrix newton(system_);
  newton.set_point(system_, 0.0, w_);
  const Eigen::Index n = system_.state_size();
  for (const double gamma : {1e-4, 0.02, 0.7}) {
    ASSERT_TRUE(newton.factorise(system_, gamma));
    const Eigen::VectorXd b = random_.values(static_cast<int>(n), 1);
    Eigen::VectorXd x(n);
    newton.solve(system_, b, x);
    const Eigen::VectorXd back = x - gamma * (J * x);
    EXPECT_LT((back - b).norm(), 1e-10 * (b.norm() + x.norm() * (1 + gamma * J.norm()))) << gamma;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobian, ::testing::Range(1u, 9u));

// With loops of several kinds between two branches, off the constraint as trial states are: the
// structured solution with multipliers is that of the whole matrix, here by central differences.
TEST(NewtonMatrixOfLoops, SolvesWithTheJacobianOfTheConstrainedMotion) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    Random random(seed);
    MechanismBuilder builder;
    builder.set_gravity(random.vector(10));
    const auto add = [&](JointKind kind, const char* name, const char* parent) {
      BodyDefinition body = examples::random_body(random, kind, name, parent);
      body.damping.assign(velocity_count(kind), 0.4);
      builder.add_body(body);
    };
    add(JointKind::free, "a1", "world");
    add(JointKind::universal, "a2", "a1");
    add(JointKind::spherical, "b1", "world");
    add(JointKind::planar, "b2", "b1");
    add(JointKind::revolute, "c", "b2");
    const auto loop = [&](LoopKind kind, const char* first, const char* second) {
      LoopDefinition definition;
      definition.name = std::string(loop_kind_name(kind)) + first;
      definition.kind = kind;
      definition.first = first;
      definition.second = second;
      definition.X_FirstK = Pose::translation(random.vector(1));
      definition.X_SecondK = Pose::translation(random.vector(1));
      if (kind == LoopKind::distance) definition.length = 2.0;
      builder.add_loop(definition);
    };
    loop(LoopKind::universal, "a2", "b2");
    loop(LoopKind::distance, "a1", "c");
    loop(LoopKind::point_on_line, "world", "a1");
    LoopDefinition rope;
    rope.name = "rope";
    rope.kind = LoopKind::rope_length;
    rope.length = 4.0;
    rope.paths = {{{"world", random.vector(1)}, {"b1", random.vector(1)}, {"c", random.vector(1)}}};
    builder.add_loop(rope);
    LiftSystem system = alone(builder.build(), random);
    LiftWorkspace w(system);
    Eigen::VectorXd y(system.state_size());
    get_state(system, system.q_start(), random.values(system.mechanism().nv(), 1), y);
    const Eigen::MatrixXd J = difference_jacobian(system, 0.0, y, nullptr, w, 1e-6);
    Eigen::VectorXd b = random.values(static_cast<int>(y.size()), 1);
    Eigen::VectorXd x(y.size());
    calc_right_hand_side(system, 0.0, y, nullptr, w, x);
    ASSERT_EQ(w.loops->rank, 8);
    NewtonMatrix newton(system);
    newton.set_point(system, 0.0, w);
    for (const double gamma : {1e-3, 0.05}) {
      ASSERT_TRUE(newton.factorise(system, gamma));
      newton.solve(system, b, x);
      EXPECT_LT((x - gamma * (J * x) - b).norm(), 1e-5 * (b.norm() + gamma * J.norm() * x.norm()))
          << seed << " " << gamma;
    }
  }
}

TEST(JacobianOfALift, IsThatOfDifferencesWhileItSwings) {
  const LiftSystem lift = test::two_goliaths();
  LiftWorkspace w(lift);
  Random random(3);
  Eigen::VectorXd y(lift.state_size());
  get_state(lift, lift.q_start(), random.values(lift.mechanism().nv(), 0.2), y);
  const Contacts contacts = find_contacts(lift, 20.0, y, w);
  JacobianWorkspace workspace(lift);
  Eigen::MatrixXd J(lift.state_size(), lift.state_size());
  calc_jacobian(lift, 20.0, y, &contacts, w, workspace, J);
  // Stiff ropes: entries up to k/m = 1e4 s-2, rounding 1e-16 x 90 m x 1e4 / 1e-5.
  EXPECT_LT(error(difference_jacobian(lift, 20.0, y, &contacts, w, 1e-5), J), 1e-7);
}

// A block that turns on a sling round its two lower edges, which are not parallel, so that the
// sling slides along them; its hook moves, too.
LiftSystem cradle(double radius) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -9.80665});
  builder.add_body({.name = "block",
                    .joint = {.kind = JointKind::free},
                    .mass = 2,
                    .I_BBcm_B = Vector3(4, 5, 6).asDiagonal()});
  builder.add_body({.name = "hook", .joint = {.kind = JointKind::translational}, .mass = 1});
  Mechanism mechanism = builder.build();
  const RopeDefinition sling{.name = "sling",
                             .points = {{2, {-0.5, 0, 10}}, {2, {0.7, 0, 10}}},
                             .axial_stiffness = 400,
                             .damping_time = 0.1,
                             .unstretched_length = 22,
                             .edges = {{.name = "port",
                                        .body = 1,
                                        .begin_B = {-3, -2, -1.7},
                                        .end_B = {3, -2, -1},
                                        .outside_B = {0, -1, -1},
                                        .radius = radius},
                                       {.name = "starboard",
                                        .body = 1,
                                        .begin_B = {-3, 2, -1},
                                        .end_B = {3, 2.4, -1},
                                        .outside_B = {0, 1, -1},
                                        .radius = radius}}};
  std::vector<Rope> ropes{Rope(mechanism, sling)};
  const Eigen::VectorXd q = mechanism.zero_configuration();
  return LiftSystem({.mechanism = std::move(mechanism),
                     .ropes = std::move(ropes),
                     .supports = {},
                     .elements = {},
                     .operation = OperationBuilder().build(1.0),
                     .q_start = q,
                     .v_start = {}});
}

TEST(JacobianOfALift, IsThatOfDifferencesOverEdges) {
  for (const double radius : {0.0, 0.4}) {
    const LiftSystem lift = cradle(radius);
    LiftWorkspace w(lift);
    Random random(5);
    Eigen::VectorXd q(lift.mechanism().nq());
    lift.mechanism().integrate(lift.q_start(), random.values(lift.mechanism().nv(), 0.2), 1.0, q);
    Eigen::VectorXd y(lift.state_size());
    get_state(lift, q, random.values(lift.mechanism().nv(), 0.5), y);
    const Contacts contacts(static_cast<std::size_t>(lift.contact_count()), 1);
    JacobianWorkspace workspace(lift);
    Eigen::MatrixXd J(lift.state_size(), lift.state_size());
    calc_jacobian(lift, 0.0, y, &contacts, w, workspace, J);
    EXPECT_LT(error(difference_jacobian(lift, 0.0, y, &contacts, w, 1e-5), J), 1e-7) << radius;
  }
}

// Slack ropes and pads in the air have no part in it.
TEST(JacobianOfALift, LeavesOutWhatDoesNotAct) {
  examples::SingleRopeLift lift;
  const LiftSystem system = lift.build();
  LiftWorkspace w(system);
  Eigen::VectorXd y(6);
  y << 0, 0, -lift.length + 1.0, 0, 0, 0;
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd J(6, 6);
  calc_jacobian(system, 0.0, y, nullptr, w, workspace, J);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
  expected.topRightCorner(3, 3).setIdentity();
  EXPECT_EQ(J, expected);
}

}  // namespace
}  // namespace blocklift::dynamics
