// Motion profiles: limits kept, ends met exactly, derivatives consistent.
#include "dynamics/multibody/motion_profile.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "dynamics/errors.h"
#include "pipeline/verification/models/random_mechanism.h"

namespace blocklift::dynamics {
namespace {

using examples::Random;
using ::testing::HasSubstr;

template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

// Velocity and acceleration are the derivatives of the position, by central differences over h.
template <class Profile>
double derivative_error(const Profile& profile, double t, double h, double jerk) {
  const ProfileValue at = profile.evaluate(t);
  const ProfileValue before = profile.evaluate(t - h);
  const ProfileValue after = profile.evaluate(t + h);
  const double velocity = (after.position - before.position) / (2 * h) - at.velocity;
  const double acceleration = (after.velocity - before.velocity) / (2 * h) - at.acceleration;
  return std::max(std::abs(velocity) / (jerk * h * h), std::abs(acceleration) / (jerk * h));
}

struct RandomMove {
  explicit RandomMove(unsigned seed) : random(seed) {
    const auto magnitude = [&](double low, double high) {
      return std::pow(10.0, random.uniform(low, high));
    };
    start = random.uniform(-10, 100);
    distance = (random.integer(0, 1) == 0 ? -1 : 1) * magnitude(-3, 2);
    limits = {magnitude(-2, 1), magnitude(-2, 1), magnitude(-2, 1)};
  }
  Random random;
  double start;
  double distance;
  MotionLimits limits;
};

TEST(RestToRestMove, KeepsItsLimitsAndEndsExactly) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    RandomMove m(seed);
    const RestToRestMove move(m.start, m.distance, m.limits);
    RC_ASSERT(move.evaluate(m.start).position == 0);
    RC_ASSERT(move.evaluate(move.end() + 1e-9).position == m.distance);
    RC_ASSERT(std::abs(move.evaluate(move.end() * (1 - 1e-15)).position - m.distance) <
              1e-12 * std::abs(m.distance));
    double previous = 0;
    for (int i = 0; i <= 500; ++i) {
      const ProfileValue at = move.evaluate(m.start + i / 500.0 * move.duration());
      RC_ASSERT(std::abs(at.velocity) <= m.limits.speed * (1 + 1e-12));
      RC_ASSERT(std::abs(at.acceleration) <= m.limits.acceleration * (1 + 1e-12));
      const double progress = at.position / m.distance;
      RC_ASSERT(progress >= previous - 1e-14);
      previous = progress;
    }
    // Jerk limit and consistency at once: the acceleration changes by at most jerk times time.
    const double h = 1e-4 * move.duration();
    for (int i = 0; i < 200; ++i) {
      const double t = m.random.uniform(m.start - h, move.end() + h);
      RC_ASSERT(derivative_error(move, t, h, m.limits.jerk) < 1.01);
    }
  }));
}

// Nothing is faster: with one limit alone active, the classical times come out.
TEST(RestToRestMove, TakesTheLeastTime) {
  // Jerk-limited: distance = 2 j t^3, four segments of t.
  EXPECT_NEAR(RestToRestMove(0, 2.0, {100, 100, 1}).duration(), 4.0, 1e-12);
  // Full cruise: d/v + v/a + a/j.
  EXPECT_NEAR(RestToRestMove(0, 50.0, {2, 0.5, 0.25}).duration(), 25.0 + 4.0 + 2.0, 1e-12);
  // Full acceleration without cruise: t_j = 1, t_a from a (tj + ta)(2 tj + ta) = 6, so t_a = 1.
  EXPECT_NEAR(RestToRestMove(0, 6.0, {100, 1, 1}).duration(), 6.0, 1e-12);
  EXPECT_EQ(RestToRestMove(3, 0.0, {1, 1, 1}).duration(), 0.0);
}

TEST(RestToRestMove, StretchesToADuration) {
  const RestToRestMove move(5, -12, {0.5, 0.1, 0.1}, 60);
  EXPECT_NEAR(move.end(), 65, 1e-12);
  EXPECT_EQ(move.evaluate(65.0001).position, -12);
  EXPECT_NEAR(move.evaluate(35).position, -6, 1e-12);
  EXPECT_LT(derivative_error(move, 20, 1e-3, 0.1), 1.01);
  EXPECT_THAT(message_of([] {
                RestToRestMove(0, 12, {0.5, 0.1, 0.1}, 20);
              }),
              HasSubstr("is to last 20 s but takes at least 30 s"));
}

TEST(RestToRestMove, RefusesLimitsThatAreNotPositive) {
  EXPECT_THAT(message_of([] { RestToRestMove(0, 1, {1, 0, 1}); }), HasSubstr("acceleration 0"));
  EXPECT_THAT(message_of([] { RestToRestMove(0, NAN, {1, 1, 1}); }), HasSubstr("not finite"));
}

TEST(NaturalSpline, PassesItsPointsSmoothlyWithStraightEnds) {
  Random random(21);
  const std::vector<double> x{0, 1, 1.5, 3, 4};
  const std::vector<double> y{2, 0, 1, -1, 5};
  const NaturalSpline spline(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(spline.evaluate(x[i]).position, y[i], 1e-14);
    const ProfileValue below = spline.evaluate(x[i] - 1e-12);
    const ProfileValue above = spline.evaluate(x[i] + 1e-12);
    EXPECT_NEAR(below.velocity, above.velocity, 1e-9);
    EXPECT_NEAR(below.acceleration, above.acceleration, 1e-9);
  }
  EXPECT_EQ(spline.evaluate(0).acceleration, 0);
  EXPECT_EQ(spline.evaluate(4).acceleration, 0);
  EXPECT_EQ(spline.evaluate(9).acceleration, 0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(derivative_error(spline, random.uniform(-1, 5), 1e-5, 200), 1.0);
  }
}

// Natural splines reproduce straight lines, the only cubics without end curvature.
TEST(NaturalSpline, OfTwoPointsIsTheLineThroughThem) {
  const NaturalSpline line({1, 3}, {2, 8});
  EXPECT_NEAR(line.evaluate(2.5).position, 6.5, 1e-14);
  EXPECT_NEAR(line.evaluate(0).position, -1, 1e-14);
  EXPECT_NEAR(line.evaluate(2).velocity, 3, 1e-14);
}

TEST(NaturalSpline, RefusesAbscissaeThatDoNotIncrease) {
  EXPECT_THAT(message_of([] { NaturalSpline({0, 2, 2}, {0, 1, 2}); }), HasSubstr("2 follows 2"));
  EXPECT_THAT(message_of([] { NaturalSpline({0}, {0}); }), HasSubstr("needs two"));
  EXPECT_THAT(message_of([] {
                NaturalSpline({0, 1}, {0});
              }),
              HasSubstr("2 abscissae and 1 values"));
}

MotionProfile two_moves() {
  const MotionLimits limits{1, 0.5, 0.5};
  return MotionProfile::sequence(10, {{20, -5, limits}, {2, 3, limits}});
}

TEST(MotionProfile, MakesItsMovesOneAfterAnother) {
  const MotionProfile profile = two_moves();
  EXPECT_EQ(profile.evaluate(0).position, 10);
  EXPECT_EQ(profile.evaluate(15).position, 13);
  EXPECT_EQ(profile.evaluate(100).position, 8);
  EXPECT_EQ(profile.breakpoints().front(), 2);
  EXPECT_TRUE(std::is_sorted(profile.breakpoints().begin(), profile.breakpoints().end()));
  const ProfileRange range = profile.range();
  EXPECT_EQ(range.highest, 13);
  EXPECT_EQ(range.lowest, 8);
  EXPECT_NEAR(range.peak_speed, 1, 1e-12);
  EXPECT_NEAR(range.peak_acceleration, 0.5, 1e-12);
  for (double t = 0; t < 40; t += 0.13)
    EXPECT_LT(derivative_error(profile, t, 1e-4, 0.5), 1.01) << t;
}

TEST(MotionProfile, RefusesMovesThatOverlap) {
  const MotionLimits limits{1, 1, 1};
  EXPECT_THAT(
      message_of([&] {
        MotionProfile::sequence(0, {{0, 5, limits}, {3, 1, limits}});
      }),
      HasSubstr("a move starts at 3 s while the one before it, started at 0 s, lasts until 7"));
}

TEST(MotionProfile, CamFollowsItsLeader) {
  const NaturalSpline spline({8, 10, 11, 13}, {0, 1, 4, 2});
  const MotionProfile cam = MotionProfile::cam(two_moves(), spline);
  EXPECT_NEAR(cam.evaluate(0).position, 1, 1e-14);
  EXPECT_NEAR(cam.evaluate(15).position, 2, 1e-14);
  EXPECT_NEAR(cam.evaluate(50).position, 0, 1e-14);
  for (double t = 0; t < 40; t += 0.13) EXPECT_LT(derivative_error(cam, t, 1e-4, 50), 1.0) << t;
  EXPECT_THAT(message_of([] {
                MotionProfile::cam(two_moves(), NaturalSpline({9, 12}, {0, 1}));
              }),
              HasSubstr("a cam is given from 9 to 12 but its leader goes from 8 to 13"));
}

// From a constant speed v the stop takes v D / 2 at the deceleration v / D, wherever in D.
TEST(MotionProfile, StopsWithinItsTime) {
  const MotionProfile cruise = MotionProfile::along(NaturalSpline({0, 100}, {0, 200}));
  const MotionProfile stopped = MotionProfile::stopped(cruise, 10, 0.5);
  EXPECT_EQ(stopped.evaluate(10).position, 20);
  EXPECT_EQ(stopped.evaluate(10).velocity, 2);
  EXPECT_NEAR(stopped.evaluate(10.2).position, 20 + 2 * (0.2 - 0.2 * 0.2 / (2 * 0.5)), 1e-12);
  EXPECT_NEAR(stopped.evaluate(10.2).velocity, 2 * 0.6, 1e-12);
  EXPECT_NEAR(stopped.evaluate(10.2).acceleration, -4, 1e-12);
  EXPECT_NEAR(stopped.evaluate(50).position, 20 + 2 * 0.5 / 2, 1e-12);
  EXPECT_EQ(stopped.evaluate(50).velocity, 0);
  EXPECT_EQ(stopped.evaluate(50).acceleration, 0);
  // In the middle of moves, too, rates are those of the position.
  const MotionProfile moved = MotionProfile::stopped(two_moves(), 3.7, 1.5);
  for (double t = 0; t < 8; t += 0.13) {
    if (std::abs(t - 3.7) < 1e-3 || std::abs(t - 5.2) < 1e-3) continue;
    EXPECT_LT(derivative_error(moved, t, 1e-4, 50), 1.01) << t;
  }
  const std::vector<double>& times = moved.breakpoints();
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(times.back(), 5.2);
  EXPECT_THAT(message_of([&] { MotionProfile::stopped(cruise, 1, 0); }),
              HasSubstr("some time is due"));
}

TEST(MotionProfile, SumsProfiles) {
  const MotionProfile sum =
      MotionProfile::sum({two_moves(), MotionProfile::constant(5), two_moves()});
  EXPECT_EQ(sum.evaluate(15).position, 13 + 5 + 13);
  EXPECT_EQ(sum.evaluate(4).velocity, 2 * two_moves().evaluate(4).velocity);
  EXPECT_EQ(sum.breakpoints(), two_moves().breakpoints());
  EXPECT_EQ(MotionProfile::constant(5).range().highest, 5);
}

}  // namespace
}  // namespace blocklift::dynamics
