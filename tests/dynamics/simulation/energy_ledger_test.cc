// Powers and energies of an integration: that the short way to them is right, and what waves do.
#include "dynamics/simulation/energy_ledger.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

void expect_equal(const EnergyRates& a, const EnergyRates& b) {
  const auto expect_near = [](double x, double y) {
    EXPECT_NEAR(x, y, 1e-12 * (1.0 + std::abs(y)));
  };
  expect_near(a.drive_power, b.drive_power);
  expect_near(a.winch_power, b.winch_power);
  expect_near(a.outside_power, b.outside_power);
  expect_near(a.dissipated_power, b.dissipated_power);
}

// Where no joint is driven accelerations are left out, and nothing is missed by it.
TEST(EnergyLedger, FindsThePowersWithoutTheAccelerationsToo) {
  const LiftSystem lift = test::two_goliaths();
  LiftWorkspace w(lift), full(lift);
  Eigen::VectorXd y(lift.state_size()), ydot(lift.state_size());
  get_state(lift, lift.q_start(), lift.v_start(), y);
  y.tail(lift.nv_free()).setConstant(0.02);
  const Contacts contacts = find_contacts(lift, 0.0, y, w);
  int driven = 0, at_rest = 0;
  for (double t = 0.0; t < lift.operation().duration(); t += 5.0) {
    calc_right_hand_side(lift, t, y, &contacts, full, ydot);
    const EnergyRates powers = calc_energy_rates(lift, t, full);
    ++(powers.drive_power != 0.0 ? driven : at_rest);
    expect_equal(calc_energy_rates(lift, t, y, &contacts, HullForces::evaluated, w), powers);
  }
  EXPECT_GT(driven, 5);
  EXPECT_GT(at_rest, 5);
}

/// A box of 12 x 6 x 3 m adrift in a regular wave.
struct BoxAdrift {
  static LiftSystem build(double duration) {
    const double mass = 1025 * 12 * 6 * 1.5;
    MechanismBuilder builder;
    builder.add_body({.name = "box",
                      .joint = {.kind = JointKind::free},
                      .mass = mass,
                      .I_BBcm_B = examples::box_inertia(mass, 12, 6, 3)});
    const auto sea = std::make_shared<const Sea>(
        Sea{WaveField({.density = 1025, .gravity = 9.81}, {{0.3, 1.2, 0.4, 0}}), {}});
    ForceElements elements;
    std::get<std::vector<HullForce>>(elements).emplace_back(HullForce::Definition{
        "hull", 1, std::make_shared<const HullClusters>(make_box({12, 6, 3}, {8, 4, 2, 1})), sea});
    const Mechanism mechanism = builder.build();
    Eigen::VectorXd q = mechanism.zero_configuration();
    q[2] = -0.1;
    return LiftSystem({.mechanism = mechanism,
                       .elements = std::move(elements),
                       .operation = OperationBuilder().build(duration),
                       .q_start = q});
  }
};

// The work of the waves is what they add to still water, though all of the pressure's is summed:
// against Simpson's rule over the samples.
TEST(EnergyLedger, CountsWhatWavesAddToStillWater) {
  const LiftSystem system = BoxAdrift::build(12.0);
  const HullForce& hull = std::get<std::vector<HullForce>>(system.elements())[0];
  constexpr double interval = 0.05;
  std::vector<double> powers;
  IntegrationSettings settings{.relative_tolerance = 1e-8, .sample_interval = interval};
  settings.observe = [&](Eigen::Index, double t, const LiftWorkspace& w) {
    powers.push_back(hull.calc_energy({t, w.q, w.v, w.kinematics}).supplied_power);
  };
  const History history = integrate(system, system.q_start(), system.v_start(), settings).history;
  const EnergyHistory& e = history.energy;
  double work = 0.0, largest = 0.0, imbalance = 0.0, turnover = 0.0;
  for (std::size_t i = 2; i < powers.size(); i += 2) {
    const auto k = static_cast<Eigen::Index>(i);
    work += interval / 3 * (powers[i - 2] + 4 * powers[i - 1] + powers[i]);
    largest = std::max(largest, std::abs(work));
    EXPECT_NEAR(e.outside_work[k], work, 1e-4 * std::max(largest, 1e3)) << history.time[k];
    const auto sum = [&](Eigen::Index n) { return e.kinetic[n] + e.gravity[n] + e.elastic[n]; };
    imbalance = std::max(imbalance, std::abs(sum(k) - sum(0) - e.outside_work[k]));
    turnover = std::max(turnover, e.kinetic[k]);
  }
  EXPECT_GT(largest, 5e3);
  EXPECT_LT(imbalance, 1e-5 * turnover);
}

// Steps take the hulls' forces from their last evaluation, which errs by what the step may: the
// balance improves with the tolerance.
TEST(EnergyLedger, ClosesTheBetterTheSmallerTheTolerance) {
  const LiftSystem system = BoxAdrift::build(12.0);
  std::vector<double> errors;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const EnergyHistory e = integrate(system, system.q_start(), system.v_start(),
                                      {.relative_tolerance = tolerance, .sample_interval = 0.05})
                                .history.energy;
    const Eigen::VectorXd sum = e.kinetic + e.gravity + e.elastic - e.outside_work;
    errors.push_back((sum.array() - sum[0]).abs().maxCoeff() / e.kinetic.maxCoeff());
  }
  EXPECT_LT(errors[1], 0.1 * errors[0]);
  EXPECT_LT(errors[2], 0.1 * errors[1]);
}

// A winch runs while its load bounces and its rope is slack now and then. Steps look beyond the
// instants at which the rope becomes taut or slack; a damped rope is slack while it is still
// stretched and loses what it stores. The account knows where, and closes to the tolerance.
TEST(EnergyLedger, ClosesWhereTheWinchRunsWhileItsRopeIsSlack) {
  for (const double damping_time : {0.0, 0.005}) {
    examples::SingleRopeLift model;
    model.mass = 20e3;
    model.duration = 6.0;
    model.damping_time = damping_time;
    model.payout = -1.5;
    model.payout_start = 0.0;
    const LiftSystem system = model.build();
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const IntegrationResult run =
          integrate(system, Vector3(0, 0, -19), Vector3::Zero(), {.relative_tolerance = tolerance});
      EXPECT_GE(run.statistics.contact_changes, 10);
      const EnergyHistory& e = run.history.energy;
      const Eigen::VectorXd sum = e.kinetic + e.gravity + e.elastic - e.winch_work + e.dissipated;
      EXPECT_LT((sum.array() - sum[0]).abs().maxCoeff(), 1e3 * tolerance * e.kinetic.maxCoeff())
          << damping_time << " s, tolerance " << tolerance;
    }
  }
}

TEST(EnergyLedger, ShortWayAllocatesNothing) {
  if (!blocklift::test::counts_allocations()) GTEST_SKIP() << "allocations cannot be counted";
  const LiftSystem system = BoxAdrift::build(1.0);
  LiftWorkspace w(system);
  Eigen::VectorXd y(system.state_size());
  get_state(system, system.q_start(), system.v_start(), y);
  const Contacts contacts;
  const long before = blocklift::test::allocations();
  double sum = 0.0;
  for (const HullForces hulls : {HullForces::evaluated, HullForces::kept}) {
    sum += calc_energy_rates(system, 1.0, y, &contacts, hulls, w).outside_power;
  }
  EXPECT_EQ(blocklift::test::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace blocklift::dynamics
