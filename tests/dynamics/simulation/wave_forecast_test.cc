// Forces of many waves, found ahead of the integration: that interpolation leaves what it is said
// to, and that bodies meet the forces that are found at each state.
#include "dynamics/simulation/wave_forecast.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/waves/wave_spectrum.h"
#include "dynamics/simulation/time_integration.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

ForecastForces forces_of(double interval, long instants, double (*value)(double)) {
  ForecastForces forces(interval, 0, 1);
  forces.begin(-0.5 * interval);
  for (long k = 0; k < instants; ++k) {
    const double t = forces.time_of(forces.next());
    forces.add();
    forces.set(0, ForceVector{Vector3::Zero(), Vector3(value(t), 0, 0)});
  }
  return forces;
}

double interpolated(ForecastForces& forces, double t) {
  forces.interpolate(t);
  return forces.force(0).force.x();
}

TEST(ForecastForces, MeetAPolynomialOfTheFifthDegree) {
  const auto polynomial = [](double t) { return 1 - t + t * t * (0.5 - 0.2 * t * t * t); };
  ForecastForces forces = forces_of(0.25, 60, polynomial);
  for (double t = 8.3; t < 14.7; t += 0.07)
    EXPECT_NEAR(interpolated(forces, t), polynomial(t), 1e-12 * std::abs(polynomial(t))) << t;
  EXPECT_LT(forces.calc_error(0, 0).force.norm(), 1e-6);
}

TEST(ForecastForces, LeaveTheRemainderOfAWaveAndTellIt) {
  const auto wave = [](double t) { return std::cos(t); };
  double largest = 0.0;
  constexpr double interval = 0.3;
  ForecastForces forces = forces_of(interval, 100, wave);
  for (double t = 22.0; t < 29.7; t += 0.01)
    largest = std::max(largest, std::abs(interpolated(forces, t) - wave(t)));
  const double bound = ForecastForces::remainder * std::pow(interval, 6);
  EXPECT_LT(largest, bound);
  EXPECT_GT(largest, 0.8 * bound);
  // The sixth difference is that of the middle of its seven instants.
  const double middle = forces.time_of(96);
  EXPECT_NEAR(forces.calc_error(0, 0).force.x(), -bound * std::cos(middle), 0.05 * bound);
}

TEST(ForecastForces, CoverWhatHasSixInstantsAboutIt) {
  const ForecastForces nothing;
  EXPECT_FALSE(nothing.covers(0, 1.0));
  const auto time = [](double t) { return t; };
  const ForecastForces six = forces_of(1.0, 6, time);  // 0 to 5
  EXPECT_FALSE(six.covers(0, 3.99));
  EXPECT_TRUE(six.covers(0, 4.0));
  EXPECT_TRUE(six.covers(0, 4.99));
  EXPECT_FALSE(six.covers(0, 5.0));
  // Those that are held the longest are forgotten.
  ForecastForces many = forces_of(1.0, 100, time);
  EXPECT_FALSE(many.covers(0, 71.0));
  EXPECT_TRUE(many.covers(0, 73.0));
  EXPECT_NEAR(interpolated(many, 73.4), 73.4, 1e-12);
  // Instants before the first one that counts are none.
  many.set_first(0, 102);
  for (int k = 0; k < 10; ++k) many.add();
  EXPECT_TRUE(many.has(0, 105.9));
  EXPECT_FALSE(many.covers(0, 105.9));
  EXPECT_TRUE(many.covers(0, 106.1));
}

/// What scatters in all directions alike: X = (cos h, sin h, 0.5, 0, 0, sin 2h) times a scale.
std::shared_ptr<const HydrodynamicDatabase> scattering_barge(double scale) {
  auto database = std::make_shared<HydrodynamicDatabase>();
  database->body_names = {"barge"};
  database->reference_points = {Vector3::Zero()};
  database->frequencies = {0.1, 10.0};
  for (int h = 0; h < 72; ++h) database->headings.push_back(h * std::numbers::pi / 36);
  Eigen::MatrixXcd X = Eigen::MatrixXcd::Zero(6, 72);
  for (Eigen::Index h = 0; h < 72; ++h) {
    const double heading = database->headings[static_cast<std::size_t>(h)];
    X(surge, h) = scale * std::cos(heading);
    X(sway, h) = scale * std::sin(heading);
    X(heave, h) = 0.5 * scale;
    X(yaw, h) = scale * std::sin(2 * heading);
  }
  database->diffraction.assign(2, X);
  return database;
}

/// A barge adrift, which also turns, in a short-crested sea of 40 waves.
struct BargeAtSea {
  double length, duration;
  bool scatters = false;
  int components = 40;

  LiftSystem build() const {
    const double mass = 1025 * length * 0.4 * length * 0.05 * length;
    MechanismBuilder builder;
    builder.add_body({.name = "barge",
                      .joint = {.kind = JointKind::free},
                      .mass = mass,
                      .I_BBcm_B = examples::box_inertia(mass, length, 0.4 * length, 0.1 * length)});
    const SeaRealisation how{.spreading_exponent = 2.0, .components = components};
    const auto sea =
        std::make_shared<const Sea>(Sea{realise(WaveSpectrum::jonswap(1.0, 7.0), {}, how), {}});
    ForceElements elements;
    std::get<std::vector<HullForce>>(elements).emplace_back(
        HullForce::Definition{"hull", 1,
                              std::make_shared<const HullClusters>(
                                  make_box({length, 0.4 * length, 0.1 * length}, {40, 16, 4, 1})),
                              sea});
    if (scatters) {
      DiffractionForce::Definition scattered;
      scattered.name = "scattered";
      scattered.frame = {1, Pose::identity()};
      scattered.database = scattering_barge(0.3 * mass);
      scattered.sea = sea;
      std::get<std::vector<DiffractionForce>>(elements).emplace_back(scattered);
    }
    const Mechanism mechanism = builder.build();
    Eigen::VectorXd q = mechanism.zero_configuration();
    q[2] = -0.002 * length;
    return LiftSystem({.mechanism = mechanism,
                       .elements = std::move(elements),
                       .operation = OperationBuilder().build(duration),
                       .q_start = q});
  }

  /// Drifts with 2 m/s, and turns by 0.1 rad/s.
  static Eigen::VectorXd velocity() {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
    v << 0, 0, 0.1, 1.6, 1.2, 0;
    return v;
  }
};

struct ForecastRun {
  long samples = 0, covered = 0, scattered_covered = 0;
  double force = 0.0, moment = 0.0;  ///< the largest that waves add to still water, N, N m
  double scattered = 0.0;            ///< the largest of what waves scatter, N
  double off = 0.0,
         off_scattered =
             0.0;  ///< largest difference from what is found at the same state, share of these
  Eigen::VectorXd q_end;
};

ForecastRun run_forecast(const LiftSystem& system, bool forecast, double tolerance = 1e-6) {
  const HullForce& hull = std::get<std::vector<HullForce>>(system.elements())[0];
  ForecastRun run;
  double force_off = 0.0, moment_off = 0.0, scattered_off = 0.0;
  IntegrationSettings settings{.relative_tolerance = tolerance, .sample_interval = 0.07};
  settings.forecast_waves = forecast;
  settings.observe = [&](Eigen::Index, double t, const LiftWorkspace& w) {
    const MotionState state{t, w.q, w.v, w.kinematics};
    const ForceVector F = hull.calc_force(state);
    const ForceVector by_waves = F - hull.calc_force(state, WaterPlane{});
    run.force = std::max(run.force, by_waves.force.norm());
    run.moment = std::max(run.moment, by_waves.moment.norm());
    const ForceVector off = w.F_Bo_W_of_hulls[0] - F;
    force_off = std::max(force_off, off.force.norm());
    moment_off = std::max(moment_off, off.moment.norm());
    ++run.samples;
    if (w.forecast.covers(0, t)) ++run.covered;
    for (const auto& scattered : std::get<std::vector<DiffractionForce>>(system.elements())) {
      const Vector3 exact = scattered.calc_force(state).force;
      run.scattered = std::max(run.scattered, exact.norm());
      scattered_off = std::max(scattered_off, (w.F_R_W_of_scattering[0].force - exact).norm());
      if (w.forecast.covers(1, t)) ++run.scattered_covered;
    }
  };
  run.q_end = integrate(system, system.q_start(), BargeAtSea::velocity(), settings).q_end;
  run.off = std::max(force_off / run.force, moment_off / run.moment);
  run.off_scattered = scattered_off / run.scattered;
  return run;
}

// Against forces that are found at each state.
TEST(WaveForecast, KnowsTheForcesOnABarge) {
  const ForecastRun run = run_forecast(BargeAtSea{80.0, 30.0, true}.build(), true);
  EXPECT_GT(run.covered, run.samples * 8 / 10);
  EXPECT_LT(run.off, WaveForecast::largest_share);
  EXPECT_GT(run.scattered_covered, run.samples * 8 / 10);
  EXPECT_LT(run.off_scattered, WaveForecast::largest_share);
}

TEST(WaveForecast, KnowsTheForcesOnASmallBarge) {
  const ForecastRun run = run_forecast(BargeAtSea{20.0, 30.0}.build(), true);
  EXPECT_GT(run.covered, run.samples * 8 / 10);
  EXPECT_LT(run.off, WaveForecast::largest_share);
}

// Where a barge that is adrift comes to within a minute: what the forecast changes is at most five
// times what a tenth of the tolerance changes.
TEST(WaveForecast, LeavesABargeWhereItCameTo) {
  const LiftSystem system = BargeAtSea{80.0, 60.0}.build();
  const Eigen::VectorXd exact = run_forecast(system, false, 1e-7).q_end;
  const double scatter = (run_forecast(system, false).q_end - exact).norm();
  EXPECT_LT((run_forecast(system, true).q_end - exact).norm(), 5.0 * scatter);
}

// A barge that is suddenly elsewhere: its forces rest, and are found at each state again.
TEST(WaveForecast, ForcesThatWereNotForeseenRest) {
  const LiftSystem system = BargeAtSea{80.0, 60.0, true}.build();
  LiftWorkspace w(system);
  w.q = system.q_start();
  w.v.setZero();
  w.vdot.setZero();
  WaveForecast forecast(system, 1e-6);
  forecast.begin(0.0, w);
  constexpr double step = 0.1;
  double t = 0.0;
  for (; t < 20.0; t += step) ASSERT_FALSE(forecast.carry_on(t, t + step, w)) << t;
  ASSERT_TRUE(w.forecast.covers(0, t));
  ASSERT_TRUE(w.forecast.covers(1, t));
  w.q[0] += 40.0;
  bool rests = false;  // a check comes after instants_of_check instants at most
  const double latest = t + (WaveForecast::instants_of_check + 1) * WaveForecast::longest_interval;
  for (; !rests && t < latest; t += step) rests = forecast.carry_on(t, t + step, w);
  EXPECT_TRUE(rests);
  EXPECT_FALSE(w.forecast.covers(0, t));
}

TEST(WaveForecast, LeavesTheForcesAsTheyAreUnlessAskedFor) {
  const ForecastRun run = run_forecast(BargeAtSea{80.0, 5.0}.build(), false);
  EXPECT_EQ(run.covered, 0);
  EXPECT_EQ(run.off, 0.0);
}

// Waves are five times as high as the freeboard of a boat of 2 m.
TEST(WaveForecast, LeavesSmallBoatsToTheWavesThemselves) {
  for (const double length : {2.0, 8.0}) {
    const ForecastRun run = run_forecast(BargeAtSea{length, 10.0}.build(), true);
    EXPECT_EQ(run.covered, 0);
    EXPECT_EQ(run.off, 0.0);
  }
}

}  // namespace
}  // namespace blocklift::dynamics
