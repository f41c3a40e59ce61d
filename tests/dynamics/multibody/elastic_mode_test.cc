// Elastic modes as coordinates of a mechanism: their place in the state, and that every algorithm
// treats them alike.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/constrained_dynamics.h"
#include "dynamics/multibody/derivatives.h"
#include "dynamics/multibody/energy.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "tests/dynamics/allocation_counter.h"

namespace blocklift::dynamics {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A driven trolley that carries a hook, and a free load with two modes, added before the hook.
Mechanism crane_with_modes() {
  MechanismBuilder builder;
  BodyDefinition trolley{.name = "trolley", .joint = {.kind = JointKind::prismatic}, .mass = 10};
  trolley.driven = {true};
  builder.add_body(trolley);
  BodyDefinition load{.name = "load", .joint = {.kind = JointKind::free}, .mass = 300};
  load.I_BBcm_B = Vector3(30, 40, 50).asDiagonal();
  load.p_BoBcm_B = Vector3(0.1, 0.2, -0.3);
  const BodyIndex body = builder.add_body(load);
  for (const double omega : {12.0, 30.0})
    builder.add_elastic_mode({.name = "load.mode_" + std::to_string(static_cast<int>(omega)),
                              .body = body,
                              .modal_mass = omega == 12.0 ? 300.0 : 1.0,
                              .angular_frequency = omega,
                              .damping_ratio = 0.02});
  BodyDefinition hook{.name = "hook",
                      .parent = "trolley",
                      .joint = {.kind = JointKind::universal, .axis = Vector3::UnitX()},
                      .mass = 5};
  hook.p_BoBcm_B = Vector3(0, 0, -4);
  builder.add_body(hook);
  return builder.build();
}

struct Moving {
  Mechanism mechanism = crane_with_modes();
  Eigen::VectorXd q = mechanism.zero_configuration();
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(mechanism.nv(), -0.4, 0.9);
  Eigen::VectorXd tau = Eigen::VectorXd::LinSpaced(mechanism.nv(), 7, -5);
  Eigen::VectorXd vdot = Eigen::VectorXd::Constant(mechanism.nv(), 0.3);  // free entries are found
  std::vector<ForceVector> forces{static_cast<std::size_t>(mechanism.body_count()),
                                  ForceVector{Vector3(1, 2, 3), Vector3(-3, 1, 50)}};
  Kinematics kinematics{mechanism};

  Moving() {
    mechanism.integrate(q, Eigen::VectorXd::LinSpaced(mechanism.nv(), 0.5, -0.2), 1, q);
    compute_kinematics(mechanism, q, v, kinematics);
    ForwardDynamicsWorkspace workspace(mechanism);
    compute_forward_dynamics(mechanism, kinematics, v, forces, workspace, tau, vdot);
  }
};

TEST(ElasticMode, StandsBehindTheJointsInTheState) {
  const Mechanism mechanism = crane_with_modes();
  EXPECT_EQ(mechanism.body_count(), 4);
  EXPECT_EQ(mechanism.nq(), 1 + 7 + 2 + 2);
  EXPECT_EQ(mechanism.nv(), 1 + 6 + 2 + 2);
  EXPECT_EQ(mechanism.elastic_modes()[1].q_index, 11);
  EXPECT_EQ(mechanism.elastic_modes()[1].v_index, 10);
  EXPECT_FALSE(mechanism.is_elastic_mode(8));
  EXPECT_TRUE(mechanism.is_elastic_mode(9));
  EXPECT_EQ(mechanism.body_of_velocity(9), mechanism.body_index("load"));
  EXPECT_EQ(mechanism.velocity_name(8), "\"hook\" (universal, velocity 2 of 2, turning)");
  EXPECT_EQ(mechanism.velocity_name(9), "\"load.mode_12\" (elastic mode)");
  EXPECT_THAT(mechanism.free_velocities(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(mechanism.driven_velocities(), ElementsAre(0));
  EXPECT_EQ(mechanism.zero_configuration().tail<2>().norm(), 0);
}

TEST(ElasticMode, AnswersItsOwnForceAlone) {
  const Moving m;
  for (const ElasticMode& mode : m.mechanism.elastic_modes()) {
    const int k = mode.v_index;
    const double omega = mode.angular_frequency;
    EXPECT_NEAR(m.vdot[k], m.tau[k] / mode.modal_mass - 2 * 0.02 * omega * m.v[k], 1e-12);
    EXPECT_DOUBLE_EQ(mode.stiffness(), mode.modal_mass * omega * omega);
  }
}

TEST(ElasticMode, InverseDynamicsAndTheMassMatrixUndoForwardDynamics) {
  const Moving m;
  InverseDynamicsWorkspace inverse(m.mechanism);
  Eigen::VectorXd tau(m.mechanism.nv()), bias(m.mechanism.nv());
  compute_inverse_dynamics(m.mechanism, m.kinematics, m.v, m.vdot, m.forces, inverse, tau);
  EXPECT_LT((tau - m.tau).norm(), 1e-10 * m.tau.norm());
  compute_inverse_dynamics(m.mechanism, m.kinematics, m.v, Eigen::VectorXd::Zero(m.v.size()),
                           m.forces, inverse, bias);
  MassMatrixWorkspace composite(m.mechanism);
  Eigen::MatrixXd mass(m.mechanism.nv(), m.mechanism.nv());
  compute_mass_matrix(m.mechanism, m.kinematics, composite, mass);
  EXPECT_LT((mass * m.vdot + bias - m.tau).norm(), 1e-10 * m.tau.norm());
}

TEST(ElasticMode, TheFactorOfTheMassMatrixLeavesItAlone) {
  const Moving m;
  ConstrainedDynamicsWorkspace workspace(m.mechanism);
  Eigen::VectorXd tau = m.tau, vdot = m.vdot;
  compute_constrained_dynamics(m.mechanism, m.kinematics, m.q, m.v, m.forces, nullptr, workspace,
                               tau, vdot);
  EXPECT_LT((vdot - m.vdot).norm(), 1e-10 * m.vdot.norm());
}

// Forward dynamics is linear in the modes' velocities: a difference is exact but for rounding.
TEST(ElasticMode, DerivativesAreThoseOfDifferences) {
  const Moving m;
  ForwardDynamicsDerivatives derivatives(m.mechanism);
  compute_forward_dynamics_derivatives(m.mechanism, m.kinematics, m.v, m.vdot, m.forces,
                                       derivatives);
  ForwardDynamicsWorkspace workspace(m.mechanism);
  for (const ElasticMode& mode : m.mechanism.elastic_modes()) {
    Eigen::VectorXd v = m.v, tau = m.tau, vdot = m.vdot;
    v[mode.v_index] += 0.1;
    Kinematics kinematics(m.mechanism);
    compute_kinematics(m.mechanism, m.q, v, kinematics);
    compute_forward_dynamics(m.mechanism, kinematics, v, m.forces, workspace, tau, vdot);
    Eigen::VectorXd by_difference = (vdot - m.vdot) / 0.1;
    by_difference[0] = (tau[0] - m.tau[0]) / 0.1;
    EXPECT_LT((derivatives.by_v.col(mode.v_index) - by_difference).norm(), 1e-9);
    EXPECT_EQ(derivatives.by_q.col(mode.v_index).norm(), 0);
  }
}

TEST(ElasticMode, CoordinatesMoveByTheirRates) {
  const Moving m;
  Eigen::VectorXd moved(m.q.size()), rates(m.q.size()), back(m.v.size());
  m.mechanism.integrate(m.q, m.v, 0.1, moved);
  m.mechanism.difference(m.q, moved, back);
  m.mechanism.calc_rates(m.q, m.v, rates);
  EXPECT_LT((back - 0.1 * m.v).norm(), 1e-12);
  EXPECT_EQ((rates.tail<2>() - m.v.tail<2>()).norm(), 0);
  Eigen::MatrixXd increments(m.v.size(), m.q.size()), by_q(m.q.size(), m.q.size());
  Eigen::MatrixXd by_v(m.q.size(), m.v.size());
  coordinate_increments(m.mechanism, m.q, increments);
  rate_derivatives(m.mechanism, m.q, m.v, by_q, by_v);
  EXPECT_TRUE((increments.bottomRightCorner<2, 2>().isIdentity()));
  EXPECT_LT((by_v * m.v - rates).norm(), 1e-12);
}

TEST(ElasticMode, HasKineticEnergyButNoMomentum) {
  const Moving m;
  Eigen::VectorXd v = m.v;
  v.tail<2>() << 2, 3;
  EXPECT_DOUBLE_EQ(calc_vibration_energy(m.mechanism, v), 0.5 * 300 * 4 + 0.5 * 1 * 9);
  const double damping = calc_damping_power(m.mechanism, v);
  EXPECT_NEAR(damping, 2 * 0.02 * (300 * 12.0 * 4 + 1 * 30.0 * 9), 1e-9);
  Kinematics kinematics(m.mechanism);
  compute_kinematics(m.mechanism, m.q, v, kinematics);
  const ForceVector change =
      calc_momentum(m.mechanism, kinematics) - calc_momentum(m.mechanism, m.kinematics);
  EXPECT_EQ(change.force.norm() + change.moment.norm(), 0);
}

TEST(ElasticMode, IsNamedWhereItsForceIsNotFinite) {
  const Moving m;
  ForwardDynamicsWorkspace workspace(m.mechanism);
  Eigen::VectorXd tau = m.tau, vdot = m.vdot;
  tau[9] = not_a_number;
  try {
    compute_forward_dynamics(m.mechanism, m.kinematics, m.v, m.forces, workspace, tau, vdot);
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("elastic mode \"load.mode_12\""));
  }
}

TEST(ElasticMode, TakesNoMemory) {
  if (!blocklift::test::counts_allocations())
    GTEST_SKIP() << "allocations cannot be counted in this build";
  Moving m;
  ForwardDynamicsWorkspace workspace(m.mechanism);
  InverseDynamicsWorkspace inverse(m.mechanism);
  const long before = blocklift::test::allocations();
  compute_forward_dynamics(m.mechanism, m.kinematics, m.v, m.forces, workspace, m.tau, m.vdot);
  compute_inverse_dynamics(m.mechanism, m.kinematics, m.v, m.vdot, m.forces, inverse, m.tau);
  m.mechanism.integrate(m.q, m.v, 0.1, m.q);
  EXPECT_EQ(blocklift::test::allocations(), before);
}

template <class Change>
std::string refusal_of(Change change) {
  MechanismBuilder builder;
  builder.add_body({.name = "load", .joint = {.kind = JointKind::prismatic}, .mass = 3});
  ElasticModeDefinition mode{
      .name = "mode", .body = 1, .modal_mass = 3, .angular_frequency = 2, .damping_ratio = 0.1};
  change(mode);
  try {
    builder.add_elastic_mode(mode);
    builder.add_elastic_mode(mode);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(ElasticMode, TheBuilderTellsWhatIsWrong) {
  EXPECT_THAT(refusal_of([](auto& m) { m.name = ""; }), HasSubstr("has no name"));
  EXPECT_THAT(refusal_of([](auto& m) { m.name = "load"; }), HasSubstr("of this name already"));
  EXPECT_THAT(refusal_of([](auto&) {}), HasSubstr("\"mode\": there is a body or mode"));
  EXPECT_THAT(refusal_of([](auto& m) { m.body = 2; }), HasSubstr("body that vibrates"));
  EXPECT_THAT(refusal_of([](auto& m) { m.body = world_index; }), HasSubstr("body that vibrates"));
  EXPECT_THAT(refusal_of([](auto& m) { m.modal_mass = 0; }), HasSubstr("its mass is 0 kg"));
  EXPECT_THAT(refusal_of([](auto& m) { m.angular_frequency = not_a_number; }),
              HasSubstr("its frequency is nan rad/s"));
  EXPECT_THAT(refusal_of([](auto& m) { m.damping_ratio = -1; }), HasSubstr("damping ratio is -1"));
}

}  // namespace
}  // namespace blocklift::dynamics
