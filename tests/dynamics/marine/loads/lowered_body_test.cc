// A body that is lowered into the water: what of each draught counts, the water that it takes up
// and leaves, and the energy of both.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/diffraction_force.h"
#include "dynamics/marine/loads/radiated_water.h"
#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/newton_matrix.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/allocation_counter.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double density = 1000;

TEST(DraughtInterpolation, SharesAreWeightsThatMeetLinesExactly) {
  const std::vector<double> draughts = {0, 1, 1.5, 4};
  const DraughtInterpolation interpolation(draughts);
  double before = -1;
  for (double d = -0.5; d < 6; d += 0.01) {
    const DraughtShares s = interpolation.calc_shares(d);
    EXPECT_NEAR(s.weight.sum(), 1, 1e-12);
    EXPECT_GE(s.weight.minCoeff(), 0);
    EXPECT_GE(s.slope.minCoeff(), -1e-12);
    double value = 0;
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_DOUBLE_EQ(s.gain[k] * s.gain[k], s.weight[k]);
      value += s.weight[k] * draughts[k];
    }
    EXPECT_GE(value, before);  // never back
    before = value;
    if (d > 1.1 && d < 1.4) {
      EXPECT_NEAR(value, d, 1e-12);
    }
    if (d > 1.8 && d < 3.7) {
      EXPECT_NEAR(value, d, 1e-12);
    }
    if (d <= 0) {
      EXPECT_EQ(s.weight[0], 1);
    }
    if (d >= 4.3) {
      EXPECT_EQ(s.weight[3], 1);
    }
    constexpr double h = 1e-6;
    const DraughtShares::Values difference =
        (interpolation.calc_shares(d + h).passed - interpolation.calc_shares(d - h).passed) /
        (2 * h);
    EXPECT_LT((difference - s.slope).cwiseAbs().maxCoeff(), 2e-4) << d;  // slope'' h in corners
  }
}

TEST(DraughtInterpolation, RefusesWhatDoesNotAscend) {
  EXPECT_THAT(
      [] {
        DraughtInterpolation({0, 2, 1});
      },
      ThrowsMessage<ModelError>(HasSubstr("ascend from zero")));
  EXPECT_THAT(
      [] {
        DraughtInterpolation({1, 2});
      },
      ThrowsMessage<ModelError>(HasSubstr("ascend from zero")));
}

/// One body whose heave added mass grows with its draught as `mass_at` says, in steps of `step` (m)
/// down to 2 m; its memory is `memory` times as much as there are tonnes of added mass.
template <class MassAt>
std::shared_ptr<const HydrodynamicSeries> series_of(const MassAt& mass_at, double step,
                                                    double memory = 0) {
  HydrodynamicSeries series;
  const auto count = static_cast<int>(std::lround(2.0 / step));
  for (int k = 0; k <= count; ++k) {
    HydrodynamicDatabase database;
    database.water = {.density = density, .gravity = 9.81};
    database.body_names = {"wedge"};
    database.reference_points = {Vector3::Zero()};
    database.infinite_added_mass = Eigen::MatrixXd::Zero(6, 6);
    database.infinite_added_mass(2, 2) = mass_at(step * k);
    database.time_step = 0.1;
    for (int n = 0; n < 80; ++n) {
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6);
      K(2, 2) = memory * mass_at(step * k) * std::exp(-(1.0 + 0.2 * k) * 0.1 * n);
      database.retardation.push_back(K);
    }
    series.draughts.push_back(step * k);
    series.databases.push_back(std::move(database));
  }
  return std::make_shared<const HydrodynamicSeries>(std::move(series));
}

RadiatedWater::Definition definition_of(std::shared_ptr<const HydrodynamicSeries> series) {
  RadiatedWater::Definition definition;
  definition.frames = {{1, Pose::identity()}};
  definition.series = std::move(series);
  definition.mark = {1, Vector3::Zero()};
  definition.fit.tolerance = 1e-3;
  return definition;
}

/// A body of 5 t that moves up and down, with a velocity (m/s) from a height (m), tied to a spring
/// or not.
LiftSystem falling(const RadiatedWater::Definition& definition, double height, double velocity,
                   double stiffness, double duration) {
  MechanismBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body({.name = "wedge",
                    .joint = {.kind = JointKind::prismatic, .axis = Vector3::UnitZ()},
                    .mass = 5e3,
                    .I_BBcm_B = Matrix3::Identity()});
  const Mechanism mechanism = builder.build();
  ForceElements elements;
  if (stiffness > 0) {
    std::get<std::vector<JointSpring>>(elements).emplace_back(
        mechanism, JointSpring::Definition{
                       .name = "spring", .body = 1, .stiffness = stiffness, .free_coordinate = 0});
  }
  return LiftSystem({.mechanism = mechanism,
                     .elements = std::move(elements),
                     .operation = OperationBuilder().build(duration),
                     .q_start = Eigen::VectorXd::Constant(1, height),
                     .v_start = Eigen::VectorXd::Constant(1, velocity),
                     .water = std::make_shared<const RadiatedWater>(definition)});
}

/// Largest error of the ledger over the energy that is turned over.
double ledger_error(const History& history) {
  const EnergyHistory& e = history.energy;
  const Eigen::VectorXd total = e.kinetic + e.gravity + e.elastic - e.outside_work + e.dissipated;
  return (total.array() - total[0]).abs().maxCoeff() / e.kinetic.maxCoeff();
}

// Von Karman (1929), NACA TN 321: a wedge of half breadth c = d/tan(beta) takes up m = rho pi c^2/2
// per length; free of other forces it keeps its momentum, V = V0/(1 + m(d)/M). The steps between
// draughts are of second order; the work that the water does not keep goes into the ledger as lost.
TEST(LoweredBody, FollowsVonKarmansWedge) {
  const auto mass_at = [](double d) {
    const double c = d / std::tan(std::numbers::pi / 6);
    return density * std::numbers::pi * c * c / 2;
  };
  constexpr double V0 = 2;
  std::vector<double> errors;
  for (const double step : {0.25, 0.125}) {
    const LiftSystem system = falling(definition_of(series_of(mass_at, step)), 0.2, -V0, 0, 0.9);
    const History history = integrate(system, system.q_start(), system.v_start(),
                                      {.relative_tolerance = 1e-9, .sample_interval = 0.01})
                                .history;
    double error = 0, deepest = 0;
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const double d = -history.bodies[0].X_WB(i).p.z();
      const double V = -history.bodies[0].V_WB(i).linear.z();
      if (d > 0.3) error = std::max(error, std::abs(V * (1 + mass_at(d) / 5e3) / V0 - 1));
      deepest = std::max(deepest, d);
    }
    ASSERT_GT(deepest, 1.0);
    errors.push_back(error);
    EXPECT_LT(ledger_error(history), 1e-6);
    EXPECT_GT(history.energy.dissipated[history.sample_count() - 1], 0);
  }
  EXPECT_LT(errors[1], 0.01);
  EXPECT_LT(errors[1], 0.35 * errors[0]);
}

// What is recorded as the body's load, the water's inertia and impact with it, is its mass times
// its acceleration: whoever puts the load on a structure finds it in balance.
TEST(LoweredBody, BearsWhatAcceleratesIt) {
  const auto mass_at = [](double d) { return 8e3 * d; };
  const LiftSystem system = falling(definition_of(series_of(mass_at, 0.5, 2.0)), 0.2, -3.0, 0, 2.0);
  const History history = integrate(system, system.q_start(), system.v_start(),
                                    {.relative_tolerance = 1e-8, .sample_interval = 0.05})
                              .history;
  double largest = 0;
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const double force = history.bodies[0].load.row(i)[5];
    const double acceleration = history.bodies[0].A_WB(i).linear.z();
    EXPECT_NEAR(force, 5e3 * (acceleration - system.mechanism().gravity().z()), 1e-9 * 72e3);
    largest = std::max(largest, std::abs(force));
  }
  EXPECT_GT(largest, 1e4);
}

// Kaplan (1992): V^2 dA/dd in sinking, no impact on leaving: what is drawn out of the water leaves
// it behind with its own velocity and keeps that itself. Either way V^3 dA/dd / 2 is lost to the
// water.
TEST(LoweredBody, FeelsAnImpactOnEnteringAndNoneOnLeaving) {
  const auto mass_at = [](double d) { return 8e3 * d; };
  for (const double velocity : {1.0, -1.0}) {
    const LiftSystem system =
        falling(definition_of(series_of(mass_at, 0.5)), -1.25, velocity, 0, 1.0);
    LiftWorkspace w(system);
    Eigen::Vector2d y(-1.25, velocity), ydot;
    const Contacts contacts;
    calc_right_hand_side(system, 0, y, &contacts, w, ydot);
    EXPECT_NEAR(ydot[1], velocity > 0 ? 0.0 : 8e3 / (5e3 + 8e3 * 1.25), 1e-9);
    EXPECT_NEAR(calc_energy_rates(system, 0, w).dissipated_power, 0.5 * 8e3, 1e-6);
    EXPECT_NEAR(calc_stored_energy(system, 0, w).kinetic, 0.5 * 15e3, 1e-6);
  }
}

// On a spring through the surface, in and out again, with a memory: energy is lost at each instant,
// and never won from a draught that changes.
TEST(LoweredBody, GainsNoEnergyFromTheSurface) {
  const auto mass_at = [](double d) { return 6e3 * d / (1 + 0.3 * d); };
  const LiftSystem system =
      falling(definition_of(series_of(mass_at, 0.5, 2.0)), 1.5, 0, 40e3, 30.0);
  ASSERT_GE(system.memory_count(), 4);
  const IntegrationResult result = integrate(system, system.q_start(), system.v_start(),
                                             {.relative_tolerance = 1e-8, .sample_interval = 0.05});
  const EnergyHistory& e = result.history.energy;
  EXPECT_LT(ledger_error(result.history), 1e-4);
  const double all = 0.5 * 40e3 * 1.5 * 1.5;
  for (Eigen::Index i = 1; i < result.history.sample_count(); ++i) {
    EXPECT_GE(e.dissipated[i], e.dissipated[i - 1] - 1e-6 * all);
    EXPECT_LT(e.outside_work[i], 1e-6 * all);  // the memory gives no more than it took
  }
  EXPECT_GT(e.dissipated[result.history.sample_count() - 1], 0.05 * all);
}

// At a draught that stays, water and Newton's matrix are those of the database there.
TEST(LoweredBody, IsTheDatabaseOfItsDraughtWhereItStays) {
  const auto mass_at = [](double d) { return 8e3 * d; };
  const auto series = series_of(mass_at, 0.5, 1.0);
  const RadiatedWater water(definition_of(series));
  const LiftSystem system = falling(definition_of(series), -0.75, 0, 10e3, 1.0);
  LiftWorkspace w(system);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(system.state_size(), 0.3), ydot(y.size());
  y.head(2) << -0.75, 0;
  const Contacts contacts;
  const long allocations = blocklift::test::allocations();
  calc_right_hand_side(system, 0, y, &contacts, w, ydot);
  if (blocklift::test::counts_allocations()) {
    EXPECT_EQ(blocklift::test::allocations(), allocations);
  }
  EXPECT_NEAR(w.added()->matrix(5, 5), 6e3, 1e-6);
  // K(t) = C exp(A t) B at zero, halfway between that of 0.5 and 1 m.
  Eigen::MatrixXd input, output;
  water.calc_input(w.water_shares, input);
  water.calc_output(w.water_shares, output);
  EXPECT_NEAR((output * input)(5, 5), 6e3, 60);

  NewtonMatrix newton(system);
  newton.set_point(system, 0, w);
  ASSERT_TRUE(newton.factorise(system, 0.05));
  JacobianWorkspace workspace(system);
  Eigen::MatrixXd J(y.size(), y.size());
  calc_jacobian(system, 0, y, &contacts, w, workspace, J);
  Eigen::VectorXd x(y.size());
  newton.solve(system, y, x);
  const Eigen::VectorXd dense =
      (Eigen::MatrixXd::Identity(y.size(), y.size()) - 0.05 * J).partialPivLu().solve(y);
  EXPECT_LT((x - dense).norm(), 1e-9 * dense.norm());
}

TEST(LoweredBody, NeedsAMarkForItsDraught) {
  RadiatedWater::Definition definition = definition_of(series_of([](double d) { return d; }, 1.0));
  definition.mark = {};
  EXPECT_THAT([&] { RadiatedWater{definition}; },
              ThrowsMessage<ModelError>(HasSubstr("no body whose draught it is")));
}

}  // namespace
}  // namespace blocklift::dynamics
