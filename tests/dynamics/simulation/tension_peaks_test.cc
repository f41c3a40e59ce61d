// Largest loads between samples: against closed forms, and against samples that leave nothing out.
#include "dynamics/simulation/tension_peaks.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/equilibrium.h"
#include "tests/dynamics/simulation/sample_lifts.h"

namespace blocklift::dynamics {
namespace {

using examples::g;

template <class Function>
std::pair<double, double> largest_of(const Function& f) {
  return find_largest_within({f(0.0), f(1.0 / 3), f(2.0 / 3), f(1.0)});
}

TEST(TensionPeaks, LargestOfAPolynomialOfThirdDegree) {
  constexpr double rounding = 1e-12;
  const auto [vertex, at_vertex] = largest_of([](double x) { return 5 - (x - 0.3) * (x - 0.3); });
  EXPECT_NEAR(vertex, 0.3, rounding);
  EXPECT_NEAR(at_vertex, 5, rounding);
  // x (1 - x)^2 is largest at a third, 4/27.
  const auto [third, at_third] = largest_of([](double x) { return x * (1 - x) * (1 - x); });
  EXPECT_NEAR(third, 1.0 / 3, rounding);
  EXPECT_NEAR(at_third, 4.0 / 27, rounding);
  EXPECT_EQ(largest_of([](double x) { return 2 * x; }), std::pair(1.0, 2.0));
  EXPECT_EQ(largest_of([](double x) { return -x; }), std::pair(0.0, 0.0));
  EXPECT_EQ(largest_of([](double) { return 7.0; }), std::pair(0.0, 7.0));
  // The lowest point within is none.
  EXPECT_EQ(largest_of([](double x) { return (x - 0.4) * (x - 0.4); }).first, 1.0);
}

// A load that is let go by `amplitude` above its rest bears m g - k amplitude cos(omega t). It is
// sampled where the cosine is 1, -0.005 and 0.948: at 0, 1 and 1.8 s.
TEST(TensionPeaks, AreThoseOfAnOscillation) {
  examples::SingleRopeLift model;
  model.duration = 1.8;
  const LiftSystem lift = model.build();
  constexpr double amplitude = 0.01;
  const double stiffness = model.stiffness(), weight = model.mass * g;
  const double omega = std::sqrt(stiffness / model.mass);
  const double rest = -model.length - weight / stiffness;
  const Vector3 start(0, 0, rest + amplitude);
  const IntegrationSettings settings{.relative_tolerance = 1e-10, .sample_interval = 1.0};
  const History plain = integrate(lift, start, lift.v_start(), settings).history;
  EXPECT_LT(find_largest_tensions(plain)[0].tension, weight + 0.01 * stiffness * amplitude);

  const History history = integrate_with_peaks(lift, start, lift.v_start(), settings).history;
  ASSERT_EQ(history.sample_count(), plain.sample_count() + 1);
  const LinkedMaximum largest = find_largest_tensions(history)[0];
  // Positions are 1e-7 m off over this time, as TimeIntegration has it, and a peak that is larger
  // by a millionth is none.
  EXPECT_NEAR(largest.tension, weight + stiffness * amplitude,
              1e-7 * stiffness + 1e-6 * 1.3 * weight);
  EXPECT_NEAR(std::cos(omega * largest.time), -1.0, 1e-6);
  // All of that sample is of that instant.
  EXPECT_NEAR(history.bodies[0].pose(largest.sample, 2), rest - amplitude, 2e-7);
  EXPECT_NEAR(history.bodies[0].acceleration(largest.sample, 5), omega * omega * amplitude, 1e-4);
  const EnergyHistory& e = history.energy;
  const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
  const Eigen::ArrayXd work = e.drive_work + e.winch_work + e.outside_work - e.dissipated;
  EXPECT_LT((energy - energy[0] - work).abs().maxCoeff(), 1e-6 * weight);
  for (Eigen::Index i = 1; i < history.sample_count(); ++i)
    EXPECT_GT(history.time[i], history.time[i - 1]);
}

// Of a turn-over that is sampled every half second: what samples every 5 ms find and a little more,
// by the same motion bit for bit, whatever is recorded of it.
TEST(TensionPeaks, AreThoseThatFineSamplesFind) {
  const LiftSystem lift = test::two_goliaths();
  Eigen::VectorXd q = lift.q_start();
  EquilibriumSolver(lift).solve(0.0, q);
  IntegrationSettings settings{.sample_interval = 0.5};
  settings.end = lift.operation().stages()[1].end;
  const IntegrationResult coarse = integrate_with_peaks(lift, q, lift.v_start(), settings);
  settings.works = false;
  settings.recording = Recording::tensions();
  const IntegrationResult least = integrate_with_peaks(lift, q, lift.v_start(), settings);
  settings.sample_interval = 0.005;
  const IntegrationResult fine = integrate(lift, q, lift.v_start(), settings);
  EXPECT_EQ(coarse.q_end, fine.q_end);
  EXPECT_EQ(coarse.statistics.steps, fine.statistics.steps);
  EXPECT_EQ(coarse.history.time, least.history.time);
  const auto peaks = find_largest_tensions(coarse.history);
  const auto fine_peaks = find_largest_tensions(fine.history);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    EXPECT_EQ(coarse.history.ropes[i].tension, least.history.ropes[i].tension);
    EXPECT_GE(peaks[i].tension, (1 - 2e-6) * fine_peaks[i].tension) << fine.history.ropes[i].name;
    EXPECT_LE(peaks[i].tension, 1.01 * fine_peaks[i].tension) << fine.history.ropes[i].name;
  }
  for (const BodyHistory& body : coarse.history.bodies)
    for (Eigen::Index i = 1; i < body.pose.rows(); ++i)
      EXPECT_GT(body.pose.row(i).tail<4>().dot(body.pose.row(i - 1).tail<4>()), 0.0) << body.name;
}

// A tension that rises in ten steps up to an instant at which the rope parts, and a history of one
// sample and its peak.
struct RisingTension {
  LiftSystem lift = examples::SingleRopeLift().build();
  History history{lift, 2, false};

  explicit RisingTension(bool ends_at_corner) {
    history.time[0] = 0;
    history.ropes[0].tension[0] = 1000;
    TensionPeaks peaks(history);
    peaks.note_sample(0);
    std::vector<RopeLoad> all(1);
    const auto loads = [&](double t) -> const std::vector<RopeLoad>& {
      all[0].tension = 1000 * (1 + t);
      return all;
    };
    const auto record = [&](double t, Eigen::Index sample) {
      history.time[sample] = t;
      history.ropes[0].tension[sample] = loads(t)[0].tension;
    };
    for (int step = 0; step < 10; ++step)
      peaks.seek({0.1 * step, 0.1 * (step + 1), ends_at_corner && step == 9}, loads, record);
    peaks.arrange();
  }
};

TEST(TensionPeaks, AreAtCornersToo) {
  const RisingTension parts(true);
  ASSERT_EQ(parts.history.sample_count(), 2);
  EXPECT_EQ(parts.history.time[1], 1.0);
  EXPECT_NEAR(parts.history.ropes[0].tension[1], 2000, 1e-9);
  EXPECT_EQ(parts.history.bodies[0].pose.rows(), 2);
  // What goes on to rise has no peak yet, and its sample is dropped.
  EXPECT_EQ(RisingTension(false).history.sample_count(), 1);
}

TEST(TensionPeaks, AreNotOfARunThatWaits) {
  const LiftSystem lift = examples::SingleRopeLift().build();
  IntegrationSettings settings;
  settings.awaited = AwaitedCondition{.kind = AwaitedCondition::Kind::slack, .rope = 0};
  EXPECT_THROW(integrate_with_peaks(lift, lift.q_start(), lift.v_start(), settings), ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics
