// Mechanisms with loops in time and at rest: references, energy, residual on the loops, drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/energy.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/loop_projection.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/simulation/sample_mechanisms.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;

double largest_residual(const History& history) {
  double result = 0;
  for (const LoopHistory& loop : history.loops) {
    result = std::max(result, loop.residual.maxCoeff());
  }
  return result;
}

// Largest change of the energy less all works, relative to the largest kinetic energy.
double energy_error(const History& history) {
  const EnergyHistory& e = history.energy;
  const Eigen::VectorXd total = e.kinetic + e.gravity + e.elastic - e.drive_work - e.winch_work -
                                e.outside_work + e.dissipated;
  return (total.array() - total[0]).abs().maxCoeff() / e.kinetic.maxCoeff();
}

double andrews_error(LoopKind kind, double tolerance) {
  const LiftSystem system = test::andrews(kind);
  const IntegrationResult run =
      integrate(system, system.q_start(), system.v_start(),
                {.relative_tolerance = tolerance, .sample_interval = 5e-3, .works = false});
  EXPECT_LT(largest_residual(run.history), 1e-12);
  return (run.q_end - test::andrews_q_end()).lpNorm<Eigen::Infinity>();
}

// The error grows some thousandfold over the motion's 2.5 turns; it follows the tolerance.
TEST(LoopSimulation, AndrewsSqueezerFollowsItsTolerance) {
  for (const LoopKind kind : {LoopKind::revolute, LoopKind::point_on_line}) {
    EXPECT_LT(andrews_error(kind, 1e-7), 1e-3);
    EXPECT_LT(andrews_error(kind, 1e-10), 2e-6);
    EXPECT_LT(andrews_error(kind, 1e-12), 4e-8);
  }
}

// Andrews' multipliers at the end: forces on the bodies' common point by K3, K4 and K6 (Test Set
// for IVP Solvers, lambda(0.03), 1 to 6).
TEST(LoopSimulation, AndrewsSqueezersForces) {
  Eigen::VectorXd wanted(6);
  wanted << 199.1753333731910, -29.75531228015052, 23.06654119098399, 31.45271365475927,
      22.64249232082739, 11.61740700019673;
  for (const LoopKind kind : {LoopKind::revolute, LoopKind::point_on_line}) {
    const LiftSystem system = test::andrews(kind);
    const History history =
        integrate(system, system.q_start(), system.v_start(), {.relative_tolerance = 1e-12})
            .history;
    const Eigen::Index last = history.sample_count() - 1;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto& force = history.loops[i].force;
      EXPECT_NEAR(force(last, 3), wanted[2 * i], 1e-6 * 200);
      EXPECT_NEAR(force(last, 4), wanted[2 * i + 1], 1e-6 * 200);
      EXPECT_NEAR(force.row(last).head<3>().norm(), 0, 1e-10);
    }
  }
}

// IFToMM A04: values of tests/verification/references, good to 9 digits.
TEST(LoopSimulation, BricardsLinkage) {
  const LiftSystem system = test::mechanism_alone(test::bricard_linkage(), Eigen::VectorXd::Zero(5),
                                                  Eigen::VectorXd::Zero(5), 10.0);
  const IntegrationResult run = integrate(system, system.q_start(), system.v_start(),
                                          {.relative_tolerance = 1e-10, .sample_interval = 0.5});
  EXPECT_LT(largest_residual(run.history), 1e-12);
  EXPECT_LT(energy_error(run.history), 5e-8);
  const BodyHistory& rod4 = run.history.body("rod4");
  const auto position = [&](Eigen::Index sample) -> Vector3 {
    return rod4.pose.row(sample).head<3>().transpose();
  };
  EXPECT_LT((position(1) - Vector3(0.968283679, -1.224625159, 0.750146609)).norm(), 2e-8);
  EXPECT_LT((position(2) - Vector3(0.510501461, -1.649167599, 0.140123115)).norm(), 2e-8);
  EXPECT_LT((position(20) - Vector3(0.999999964, -1.000269013, 0.999730951)).norm(), 1e-6);
}

// IFToMM A02, one four-bar of rods of 1 m: it passes its flat position, where the loop loses a row,
// again and again.
TEST(LoopSimulation, FourBarPassesItsTogglePosition) {
  Eigen::VectorXd q(3), v(3);
  q << M_PI / 2, -M_PI / 2, -M_PI / 2;
  v << -1, 1, -1;
  const LiftSystem system =
      test::mechanism_alone(test::four_bar(1, 1, 1, 1, false, 0.0), q, v, 10.0);
  const IntegrationResult run = integrate(system, q, v, {.relative_tolerance = 1e-10});
  EXPECT_LT(energy_error(run.history), 1e-7);
  EXPECT_LT(largest_residual(run.history), 1e-11);
  const Eigen::Index last = run.history.sample_count() - 1;
  const Vector3 B0 = run.history.body("coupler").pose.row(last).head<3>().transpose();
  EXPECT_LT((B0 - Vector3(0.4783850578, 0.8781501788, 0)).norm(), 1e-5);
}

// A driven crank moves a four-bar: energy is what the drive has done.
TEST(LoopSimulation, DriveAndItsWork) {
  Mechanism mechanism = test::four_bar(1, 3, 2, 2.5, true);
  OperationBuilder operation;
  operation.add_joint_drive(mechanism, "motor", 1, 0.3);
  operation.add_move("motor", RestToRestMove(0.1, 5.0, {3.0, 6.0, 40.0}));
  const LiftSystem system({.mechanism = std::move(mechanism),
                           .operation = operation.build(3.0),
                           .q_start = Eigen::Vector3d(0.3, 0.5, -1.5)});
  const IntegrationResult run = integrate(system, system.q_start(), system.v_start(),
                                          {.relative_tolerance = 1e-9, .sample_interval = 0.02});
  EXPECT_LT(largest_residual(run.history), 1e-12);
  EXPECT_LT(energy_error(run.history), 1e-6);
  EXPECT_GT(run.history.energy.kinetic.maxCoeff(), 1.0);
  EXPECT_NEAR(run.q_end[0], 5.3, 1e-12);
}

TEST(LoopSimulation, StartIsAssembledOrRefused) {
  const Eigen::Vector3d rough(0.3, 0.5, -1.5);
  const LiftSystem system =
      test::mechanism_alone(test::four_bar(1, 3, 2, 2.5), rough, Eigen::Vector3d(1, 0, 0), 0.01);
  const IntegrationResult run = integrate(system, rough, system.v_start());
  EXPECT_LT(run.history.loops[0].residual[0], 1e-12);
  const LiftSystem open =
      test::mechanism_alone(test::four_bar(1, 1, 1, 3.5), rough, Eigen::Vector3d::Zero(), 0.01);
  EXPECT_THAT([&] { integrate(open, rough, open.v_start()); },
              ::testing::ThrowsMessage<SimulationError>(HasSubstr("loop \"D\" by 0.5 m")));
}

TEST(LoopSimulation, StepsAllocateNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not in this build";
  const LiftSystem system = test::andrews(LoopKind::revolute);
  const auto count = [&](double tolerance) {
    const long before = blocklift::test::allocations();
    const IntegrationResult run =
        integrate(system, system.q_start(), system.v_start(),
                  {.relative_tolerance = tolerance, .sample_interval = 0.03});
    return std::pair(blocklift::test::allocations() - before, run.statistics.steps);
  };
  const auto coarse = count(1e-5);
  const auto fine = count(1e-10);
  EXPECT_GT(fine.second, 2 * coarse.second);
  EXPECT_EQ(fine.first, coarse.first);
}

TEST(LoopSimulation, NothingIsAllocatedBetweenTheFirstSampleAndTheLast) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "not in this build";
  for (const LoopKind kind : {LoopKind::revolute, LoopKind::point_on_line}) {
    const LiftSystem system = test::andrews(kind);
    long at_first = 0, at_last = 0;
    const auto observe = [&](Eigen::Index sample, double, const LiftWorkspace&) {
      (sample <= 1 ? at_first : at_last) = blocklift::test::allocations();
    };
    const IntegrationResult run =
        integrate(system, system.q_start(), system.v_start(),
                  {.relative_tolerance = 1e-7, .sample_interval = 1e-3, .observe = observe});
    EXPECT_GT(run.statistics.steps, 300);
    EXPECT_EQ(at_last, at_first);
  }
}

// ---- at rest -----------------------------------------------------------------------------------

double potential(const Mechanism& m, const Eigen::VectorXd& q) {
  Kinematics kinematics(m);
  compute_kinematics(m, q, Eigen::VectorXd::Zero(m.nv()), kinematics);
  return calc_gravity_potential(m, kinematics);
}

// Potential at the crank angle that differs by `turn`, on the loops.
double potential_beside(const Mechanism& m, Eigen::VectorXd q, double turn) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(3);
  weights[0] = 1e12;
  q[0] += turn;
  LoopProjector projector(m, weights);
  EXPECT_TRUE(projector.project_positions(q));
  return potential(m, q);
}

TEST(LoopEquilibrium, FourBarHangsAtItsLowest) {
  const LiftSystem system = test::mechanism_alone(
      test::four_bar(1, 3, 2, 2.5), Eigen::Vector3d(0.3, 0.5, -1.5), Eigen::Vector3d::Zero(), 1.0);
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const double here = potential(system.mechanism(), q);
  const double up = potential_beside(system.mechanism(), q, 1e-4);
  const double down = potential_beside(system.mechanism(), q, -1e-4);
  EXPECT_NEAR((up - down) / 2e-4, 0, 1e-6);
  const double stiffness = (up - 2 * here + down) / 1e-8;
  EXPECT_GT(stiffness, 0.1);
  // The frequency of its one mode is that of the potential over the mass along the loop.
  const Linearisation linear = linearise(system, 0.0, solver.workspace());
  ASSERT_EQ(linear.modes.size(), 1U);
  MassMatrixWorkspace composite(system.mechanism());
  Eigen::MatrixXd M(3, 3);
  compute_mass_matrix(system.mechanism(), solver.workspace().kinematics, composite, M);
  const Eigen::VectorXd along = linear.basis.col(0) / linear.basis(0, 0);
  EXPECT_NEAR(linear.modes[0].natural_frequency(), std::sqrt(stiffness / along.dot(M * along)),
              1e-5);
  // The joint forces with the loop's are in balance.
  const LiftWorkspace& w = solver.workspace();
  const Eigen::MatrixXd G = calc_loop_jacobian(system.mechanism(), w.kinematics, w.loops->loops);
  InverseDynamicsWorkspace inverse(system.mechanism());
  Eigen::VectorXd needed(3);
  compute_inverse_dynamics(system.mechanism(), w.kinematics, Eigen::Vector3d::Zero(),
                           Eigen::Vector3d::Zero(), w.loads.F_Bo_W, inverse, needed);
  EXPECT_LT((needed - G.transpose() * w.loops->lambda).norm(), 1e-7);
}

TEST(LoopEquilibrium, HeldCrankTakesTheMomentOfTheWeights) {
  Mechanism mechanism = test::four_bar(1, 3, 2, 2.5, true);
  OperationBuilder operation;
  operation.add_joint_drive(mechanism, "motor", 1, 0.3);
  operation.add_move("motor", RestToRestMove(0.0, 2.0, {1.0, 1.0, 10.0}));
  const LiftSystem system({.mechanism = std::move(mechanism),
                           .operation = operation.build(4.0),
                           .q_start = Eigen::Vector3d(0.3, 0.5, -1.5)});
  const History sweep =
      static_sweep(system, Eigen::VectorXd::LinSpaced(9, 0.0, 4.0), system.q_start());
  EXPECT_LT(largest_residual(sweep), 1e-12);
  EXPECT_NEAR(sweep.drives[0].position[8], 2.3, 1e-12);
  // dV/dtheta by differences at the start.
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const Mechanism free = test::four_bar(1, 3, 2, 2.5);
  const double moment = (potential_beside(free, q, 1e-5) - potential_beside(free, q, -1e-5)) / 2e-5;
  EXPECT_NEAR(sweep.drives[0].force[0], moment, 1e-7);
}

}  // namespace
}  // namespace blocklift::dynamics
