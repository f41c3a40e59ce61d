#include "dynamics/rope/tension_law.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/linearisation.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/models/rope_lifts.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;

// Of a fibre sling: 1 % at a tenth of 4 MN, 4 % at the whole.
const std::vector<TensionPoint> fibre{
    {0, 0}, {0.01, 4e5}, {0.02, 1.2e6}, {0.03, 2.4e6}, {0.04, 4e6}};

TEST(TensionLaw, GoesThroughItsPointsAndNeverSoftens) {
  const TensionLaw law(fibre);
  for (const TensionPoint& point : fibre) {
    EXPECT_NEAR(law.tension(point.strain), point.tension, 1e-8);
    EXPECT_NEAR(law.find_strain(point.tension), point.strain, 1e-16);
  }
  double slope = 0.0;
  for (int i = -100; i <= 600; ++i) {
    const double strain = 1e-4 * i;
    EXPECT_GE(law.slope(strain), slope * (1.0 - 1e-12)) << strain;
    slope = law.slope(strain);
    EXPECT_NEAR(law.find_strain(law.tension(strain)), strain, 1e-15);
    // No kink: a difference over a step is a slope, in spite of a knot within it.
    constexpr double h = 1e-7;
    EXPECT_NEAR((law.tension(strain + h) - law.tension(strain - h)) / (2 * h), slope, 1e-4 * slope);
    EXPECT_NEAR((law.strain_energy(strain + h) - law.strain_energy(strain - h)) / (2 * h),
                law.tension(strain), 1e-4 * std::abs(law.tension(strain)) + 10.0);
  }
}

// The strain of a rope and a spring in series is that at which their elongations add up.
TEST(TensionLaw, FindsTheStrainInSeriesWithASpring) {
  const TensionLaw law(fibre);
  for (const double strain : {-0.01, 0.002, 0.013, 0.025, 0.039, 0.06}) {
    const double elongation = 7.0 * strain + 2e-8 * law.tension(strain);
    EXPECT_NEAR(law.find_strain(elongation, 7.0, 2e-8), strain, 1e-15);
  }
}

TEST(TensionLaw, PointsInALineAreTheLine) {
  const TensionLaw law({{0, 0}, {0.01, 4e5}, {0.03, 1.2e6}, {0.05, 2e6}});
  for (const double strain : {-0.02, 0.004, 0.017, 0.044, 0.3}) {
    EXPECT_NEAR(law.tension(strain), 4e7 * strain, 1e-14 * 4e7);
    EXPECT_NEAR(law.slope(strain), 4e7, 1e-14 * 4e7);
    EXPECT_NEAR(law.strain_energy(strain), 2e7 * strain * strain, 1e-14 * 4e7);
  }
}

// A straight part stays straight, and what comes before it leads into it.
TEST(TensionLaw, KeepsAStraightPart) {
  const TensionLaw law({{0, 0}, {0.01, 1e5}, {0.02, 5e5}, {0.03, 9e5}});
  for (const double strain : {0.01, 0.013, 0.02, 0.027, 0.05})
    EXPECT_NEAR(law.tension(strain), 1e5 + 4e7 * (strain - 0.01), 1e-6);
  EXPECT_GT(law.slope(0), 0);
}

TEST(TensionLaw, RefusesWhatIsNone) {
  const auto refusal = [](const std::vector<TensionPoint>& points) {
    try {
      const TensionLaw law(points);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({{0, 0}}), HasSubstr("two points"));
  EXPECT_THAT(refusal({{0.01, 0}, {0.02, 1}}), HasSubstr("begins at no strain"));
  EXPECT_THAT(refusal({{0, 0}, {0.01, 1}, {0.01, 2}}), HasSubstr("must rise"));
  EXPECT_THAT(refusal({{0, 0}, {0.01, 2}, {0.02, 3}}), HasSubstr("steeper"));
}

/// 60 t on 20 m of that sling below a crane that gives way.
examples::SingleRopeLift lift_on_fibre() {
  examples::SingleRopeLift lift;
  lift.mass = 60e3;
  lift.crane_stiffness = 20e6;
  lift.tension_points = fibre;
  return lift;
}

// A load at rest: the elongation is that of the law at its weight, and it bounces with the tangent
// there.
TEST(TensionLaw, ALoadBouncesWithTheTangent) {
  examples::SingleRopeLift lift = lift_on_fibre();
  const TensionLaw law(fibre);
  const double weight = lift.mass * examples::g;
  const double strain = law.find_strain(weight);
  const double k = 1 / (lift.length / law.slope(strain) + 1 / lift.crane_stiffness);
  const double omega = std::sqrt(k / lift.mass);
  lift.damping_time = 2.0 * 0.03 / omega;  // 3 % of critical
  const LiftSystem system = lift.build();
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  EXPECT_NEAR(-q[2] - lift.length, lift.length * strain + weight / lift.crane_stiffness, 1e-9);
  EXPECT_NEAR(system.ropes()[0].stiffness(lift.length, weight), k, 1e-9 * k);
  const Linearisation l = linearise(system, 0.0, solver.workspace());
  ASSERT_EQ(l.modes.size(), 3U);
  EXPECT_NEAR(l.modes[2].natural_frequency() / omega, 1.0, 1e-8);
  EXPECT_NEAR(l.modes[2].damping_ratio(), 0.03, 1e-8);
}

// A load that falls into its sling and bounces while the winch runs, with slack between: all of the
// energy is accounted for, and the more exactly the finer the tolerance.
TEST(TensionLaw, EnergyOfABouncingLoadAddsUp) {
  for (const double damping_time : {0.0, 0.01}) {
    examples::SingleRopeLift lift = lift_on_fibre();
    lift.damping_time = damping_time;
    lift.payout = -1.5;
    lift.duration = 6.0;
    const LiftSystem system = lift.build();
    for (const double tolerance : {1e-6, 1e-8}) {
      const EnergyHistory e = integrate(system, system.q_start(), system.v_start(),
                                        {.relative_tolerance = tolerance, .sample_interval = 0.02})
                                  .history.energy;
      const Eigen::VectorXd sum = e.kinetic + e.gravity + e.elastic - e.winch_work + e.dissipated;
      EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), 1e3 * tolerance * e.kinetic.maxCoeff());
      EXPECT_GT(e.elastic.maxCoeff(), 1e4);
    }
  }
}

// In motion, where the damping changes with the stiffness, too: the Jacobian is the derivative.
TEST(TensionLaw, JacobianIsTheDerivative) {
  examples::SingleRopeLift lift = lift_on_fibre();
  lift.damping_time = 0.05;
  const LiftSystem system = lift.build();
  LiftWorkspace w(system);
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd jacobian(system.state_size(), system.state_size());
  Eigen::VectorXd y(system.state_size());
  const Contacts contacts(1, 1);
  get_state(system, Vector3(0.4, 0.1, -20.44), Vector3(0.3, 0.2, -0.7), y);
  calc_jacobian(system, 0, y, &contacts, w, workspace, jacobian);
  const Eigen::MatrixXd by_differences = difference_jacobian(system, 0, y, &contacts, w, 1e-6);
  EXPECT_LT((jacobian - by_differences).cwiseAbs().maxCoeff(),
            1e-6 * by_differences.cwiseAbs().maxCoeff());
}

// The same motion as with one stiffness where the curve is a line.
TEST(TensionLaw, MovesAsTheLinearRope) {
  examples::SingleRopeLift lift;
  lift.crane_stiffness = 5e6;
  lift.damping_time = 0.01;
  lift.payout = -1.0;
  lift.duration = 4.0;
  const auto run = [](const LiftSystem& system) {
    return integrate(system, system.q_start(), system.v_start(), {.relative_tolerance = 1e-10})
        .history;
  };
  const History straight = run(lift.build());
  lift.tension_points = {
      {0, 0}, {0.01, 0.01 * lift.axial_stiffness}, {0.02, 0.02 * lift.axial_stiffness}};
  const History curved = run(lift.build());
  const double most = straight.ropes[0].tension.maxCoeff();
  EXPECT_LT((straight.ropes[0].tension - curved.ropes[0].tension).cwiseAbs().maxCoeff(),
            1e-7 * most);
}

// Two legs of 10 m at 60 degrees, by hand: each pulls W / (2 sin a), and its stretched length
// follows from the curve at that tension.
TEST(TensionLaw, ATwoLegSlingSagsByHand) {
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -examples::g});
  const BodyIndex load = builder.add_body(
      {.name = "load", .joint = {.kind = JointKind::translational}, .mass = 100e3});
  const Mechanism mechanism = builder.build();
  const TensionLaw law(fibre);
  std::vector<Rope> ropes;
  for (const double side : {-5.0, 5.0})
    ropes.emplace_back(
        mechanism, RopeDefinition{.name = "leg " + std::to_string(side),
                                  .points = {{world_index, {side, 0, 0}}, {load, Vector3::Zero()}},
                                  .tension_law = law,
                                  .unstretched_length = 10.0});
  const LiftSystem system({.mechanism = mechanism,
                           .ropes = ropes,
                           .operation = OperationBuilder().build(1.0),
                           .q_start = Vector3(0, 0, -8.7)});
  EquilibriumSolver solver(system);
  Eigen::VectorXd q = system.q_start();
  solver.solve(0.0, q);
  const double length = std::hypot(5.0, q[2]);
  const double tension = 100e3 * examples::g / 2 / (-q[2] / length);
  EXPECT_NEAR(length, 10.0 * (1 + law.find_strain(tension)), 1e-9);
  EXPECT_GT(length, 10.1);
}

}  // namespace
}  // namespace blocklift::dynamics
