// Independent coordinates of mechanisms with loops: closed, and with exact derivatives away from
// the reference.
#include "dynamics/simulation/reduced_coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/simulation/jacobian.h"
#include "tests/dynamics/simulation/sample_mechanisms.h"

namespace blocklift::dynamics {
namespace {

// Generalised forces at rest and what the loops leave of them, at a place z.
class LoopedAtRest {
 public:
  explicit LoopedAtRest(LiftSystem system)
      : system_(std::move(system)),
        w_(system_),
        inverse_(system_.mechanism()),
        tau_(system_.mechanism().nv()),
        coordinates_(system_),
        tangent_(system_) {
    Eigen::VectorXd q = system_.q_start();
    coordinates_.set_reference(q);
  }

  Eigen::VectorXd reduced_force(const Eigen::VectorXd& z) {
    const Eigen::VectorXd f = balanced_force(z);
    return coordinates_.basis().transpose() * f;
  }

  Eigen::MatrixXd stiffness(const Eigen::VectorXd& z) {
    balanced_force(z);
    calc_tangent_matrices(system_, 0.0, w_, tangent_);
    return coordinates_.virtual_motions().transpose() * tangent_.stiffness * coordinates_.tangent();
  }

  Eigen::VectorXd configuration(const Eigen::VectorXd& z) {
    Eigen::VectorXd q(system_.mechanism().nq());
    coordinates_.move_to(z, q);
    return q;
  }

  const LiftSystem& system() const { return system_; }
  ReducedCoordinates& coordinates() { return coordinates_; }
  const LoopState& loops() const { return w_.loops->loops; }

 private:
  Eigen::VectorXd balanced_force(const Eigen::VectorXd& z) {
    coordinates_.move_to(z, w_.q);
    w_.v.setZero();
    w_.vdot.setZero();
    calc_loads(system_, 0.0, nullptr, w_);
    const Mechanism& m = system_.mechanism();
    compute_inverse_dynamics(m, w_.kinematics, w_.v, w_.vdot, w_.loads.F_Bo_W, inverse_, tau_);
    Eigen::VectorXd f = (w_.loads.tau - tau_)(m.free_velocities());
    compute_loops(m, w_.kinematics, w_.q, w_.v, w_.loops->loops);
    coordinates_.balance(f, w_.loops->lambda);
    return f;
  }

  LiftSystem system_;
  LiftWorkspace w_;
  InverseDynamicsWorkspace inverse_;
  Eigen::VectorXd tau_;
  ReducedCoordinates coordinates_;
  TangentMatrices tangent_;
};

LiftSystem random_system(unsigned seed, LoopKind kind) {
  examples::Random random(seed);
  Mechanism mechanism = test::random_mechanism_with_loop(random, kind);
  const Eigen::VectorXd q = examples::random_configuration(random, mechanism);
  const auto nv = mechanism.nv();
  return test::mechanism_alone(std::move(mechanism), q, Eigen::VectorXd::Zero(nv), 1.0);
}

class ReducedCoordinatesOf : public ::testing::TestWithParam<LoopKind> {};

// Differences over 1e-5: central ones have relative errors of some 1e-9, the way that a step of
// 1e-5 goes is that of the tangent but for its curvature, 1e-5 of it.
TEST_P(ReducedCoordinatesOf, HaveExactDerivativesAwayFromTheReference) {
  constexpr double h = 1e-5;
  for (const unsigned seed : {1U, 2U, 3U}) {
    LoopedAtRest lift(random_system(seed, GetParam()));
    const Mechanism& mechanism = lift.system().mechanism();
    const Eigen::Index n = lift.coordinates().size();
    ASSERT_GT(n, 0);
    examples::Random random(seed + 10);
    const Eigen::VectorXd z = random.values(static_cast<int>(n), 0.1);
    const Eigen::MatrixXd stiffness = lift.stiffness(z);
    const Eigen::VectorXd q = lift.configuration(z);
    const Eigen::MatrixXd tangent = lift.coordinates().tangent();
    Eigen::MatrixXd differences(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, j);
      differences.col(j) = -(lift.reduced_force(z + step) - lift.reduced_force(z - step)) / (2 * h);
      Eigen::VectorXd beside(mechanism.nq());
      mechanism.integrate(q, tangent.col(j), h, beside);
      const Eigen::VectorXd moved = lift.configuration(z + step);
      EXPECT_LT((moved - beside).norm(), 1e-3 * h * tangent.col(j).norm()) << "seed " << seed;
    }
    EXPECT_LT((differences - stiffness).norm(), 1e-7 * stiffness.norm()) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReducedCoordinatesOf,
                         ::testing::Values(LoopKind::revolute, LoopKind::universal,
                                           LoopKind::spherical, LoopKind::planar,
                                           LoopKind::distance, LoopKind::point_on_line,
                                           LoopKind::gear, LoopKind::rope_length),
                         [](const auto& kind) { return std::string(loop_kind_name(kind.param)); });

// At the reference itself the multipliers are the least and the same forces remain.
TEST(ReducedCoordinates, BalanceRedundantLoopsAlikeByBothWays) {
  LoopedAtRest lift(test::mechanism_alone(
      test::four_bar(1, 3, 2, 2.5), Eigen::Vector3d(0.3, 0.5, -1.5), Eigen::Vector3d::Zero(), 1.0));
  ASSERT_EQ(lift.coordinates().size(), 1);
  lift.configuration(Eigen::VectorXd::Zero(1));
  const Eigen::Vector3d force(1, -2, 0.5);
  Eigen::VectorXd once = force, again = force;
  Eigen::VectorXd lambda(5), least(5);
  lift.coordinates().balance(once, lambda);
  lift.coordinates().balance_at_reference(again, least);
  EXPECT_LT((once - again).norm(), 1e-12);
  EXPECT_LE(least.norm(), lambda.norm() + 1e-12);
}

// Short bars over a long base: turned further than they reach, refused by the loop's name.
TEST(ReducedCoordinates, SayWhichLoopCannotBeClosedFarOff) {
  LoopedAtRest lift(test::mechanism_alone(test::four_bar(1, 1, 1, 2.5),
                                          Eigen::Vector3d(0.7, -0.7, -0.7), Eigen::Vector3d::Zero(),
                                          1.0));
  try {
    lift.configuration(Eigen::VectorXd::Constant(1, 3.0));
    FAIL() << "closed";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("\"D\""));
  }
}

}  // namespace
}  // namespace blocklift::dynamics
