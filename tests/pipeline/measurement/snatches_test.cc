// What happened on the lift and was not computed, beside what cells and their lines do.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/measurement/credible_samples.h"

namespace blocklift::pipeline {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A minute, ten samples a second.
TimeSeries minute_of(const std::function<double(double)>& value) {
  TimeSeries series;
  for (int i = 0; i <= 600; ++i) {
    series.time.push_back(0.1 * i);
    series.values.push_back(value(series.time.back()));
  }
  return series;
}

double swing(double t) { return 47e3 + 2e3 * std::sin(0.5 * std::numbers::pi * t); }
double noise(double t) { return 30 * std::sin(777 * t); }

JudgedSamples judge_against_swing(const std::function<double(double)>& measured) {
  return judge_samples(minute_of([&](double t) { return measured(t) + noise(t); }),
                       minute_of(swing), true);
}

/// A load of which a rope that had come loose takes hold, and that dances on it: the period of a
/// bounce, its damping, and its height at the first sample.
std::function<double(double)> dance(double begin, double period, double damping, double height) {
  return [=](double t) {
    if (t < begin - 0.01) return 0.0;
    const double phase = 2 * std::numbers::pi * (t - begin) / period;
    return height * std::exp(-damping * phase) * std::cos(phase);
  };
}

// Whatever the period of the bounce is to that of the samples.
TEST(Snatches, AreKeptWhereTheLoadDancesBehindThem) {
  for (const double period : {0.19, 0.23, 0.31, 0.47}) {
    const auto bounce = dance(20, period, 0.05, 30e3);
    const JudgedSamples judged =
        judge_against_swing([&](double t) { return swing(t) + bounce(t); });
    EXPECT_THAT(judged.faults, IsEmpty()) << period;
    ASSERT_FALSE(judged.snatches.empty()) << period;
    EXPECT_NEAR(static_cast<double>(judged.snatches.front().begin), 200, 1) << period;
    EXPECT_NEAR(judged.snatches.front().leap, 30e3, 3e3) << period;
  }
}

// A rope that slackens over two seconds, and takes the load in one sample.
TEST(Snatches, AreKeptWhereTheRopeWasSlack) {
  const auto share = [](double t) {
    if (t < 20) return 1.0;
    return t < 23.95 ? std::clamp((22 - t) / 2, 0.0, 1.0) : 1.0;
  };
  const JudgedSamples judged = judge_against_swing(
      [&](double t) { return share(t) * swing(t) + (std::abs(t - 24) < 0.01 ? 40e3 : 0); });
  EXPECT_THAT(judged.snatches, SizeIs(1));
  EXPECT_EQ(count_left_out(judged.faults, 601), 0U);
}

// A spike while the load still dances is none of its leaps, before or behind which the load swings
// as far.
TEST(Snatches, DoNotTakeASpikeAlongThatFollowsThem) {
  const auto bounce = dance(20, 0.31, 0.05, 30e3);
  for (const int later : {12, 15, 20}) {
    const double instant = 20 + 0.1 * later;
    const JudgedSamples judged = judge_against_swing(
        [&](double t) { return swing(t) + bounce(t) + (std::abs(t - instant) < 0.01 ? 40e3 : 0); });
    ASSERT_THAT(judged.faults, SizeIs(1)) << later;
    EXPECT_EQ(judged.faults.front().begin, static_cast<std::size_t>(200 + later));
    ASSERT_FALSE(judged.snatches.empty()) << later;
    EXPECT_NEAR(static_cast<double>(judged.snatches.front().begin), 200, 1) << later;
  }
}

// One sample, or one that an amplifier spreads over its neighbours, and a line that leaps to zero.
TEST(Snatches, AreNoSpikes) {
  const auto at = [](double t, double instant) { return std::abs(t - instant) < 0.01; };
  const auto lone = [&](double t) { return swing(t) + (at(t, 20) ? 40e3 : 0); };
  const auto spread = [&](double t) {
    return swing(t) + (t > 19.99 ? 40e3 * std::exp(-(t - 20) / 0.08) : 0);
  };
  const auto open_line = [&](double t) {
    if (at(t, 24)) return 90e3;
    return t > 20 && t < 24 ? 0 : swing(t);
  };
  for (const std::function<double(double)>& measured :
       {std::function<double(double)>(lone), std::function<double(double)>(spread),
        std::function<double(double)>(open_line)}) {
    const JudgedSamples judged = judge_against_swing(measured);
    EXPECT_THAT(judged.snatches, IsEmpty());
    EXPECT_GT(count_left_out(judged.faults, 601), 0U);
  }
}

// A spike while the rope is slack bears nothing behind it.
TEST(Snatches, AreNoSpikesOfASlackRope) {
  const auto measured = [](double t) {
    const double share = std::clamp((std::abs(t - 30) - 5) / 3, 0.0, 1.0);
    return share * swing(t) + (std::abs(t - 30) < 0.01 ? 40e3 : 0);
  };
  const JudgedSamples judged = judge_against_swing(measured);
  EXPECT_THAT(judged.snatches, IsEmpty());
  EXPECT_THAT(judged.faults, SizeIs(1));
}

// A load that is taken over five seconds later, or sooner, than computed is no other zero.
TEST(FaultySamples, AreNoLoadThatIsTakenOverAtAnotherTime) {
  const auto taken_over = [](double t, double instant) {
    return (t < instant - 0.01 ? 0.5 : 1) * swing(t);
  };
  const TimeSeries computed = minute_of([&](double t) { return taken_over(t, 30); });
  for (const double instant : {25.0, 35.0}) {
    const TimeSeries measured =
        minute_of([&](double t) { return taken_over(t, instant) + noise(t); });
    EXPECT_FALSE(find_suspects(measured, true).empty());
    EXPECT_THAT(find_faults(measured, computed, true), IsEmpty()) << instant;
  }
  const TimeSeries restarted =
      minute_of([&](double t) { return taken_over(t, 30) + (t > 40.01 ? 20e3 : 0) + noise(t); });
  EXPECT_EQ(count_left_out(find_faults(restarted, computed, true), 601), 200U);
}

/// What is found of a rope by what another one beside it does; both are computed to swing.
JudgedSamples judge_beside(const std::function<double(double)>& measured,
                           const std::function<double(double)>& beside) {
  const TimeSeries computed = minute_of(swing), other = minute_of(beside);
  return judge_samples(minute_of([&](double t) { return measured(t) + noise(t); }), computed, true,
                       {{&other, &computed}});
}

// A rope that loses three tenths for good: another takes them over, or nobody does.
TEST(FaultySamples, AreNoLoadThatAnotherRopeTakesOver) {
  const auto times = [](double factor) {
    return [=](double t) { return (t < 29.99 ? 1 : factor) * swing(t); };
  };
  const JudgedSamples taken_over = judge_beside(times(0.7), times(1.3));
  EXPECT_THAT(taken_over.faults, IsEmpty());
  ASSERT_THAT(taken_over.load_changes, SizeIs(1));
  EXPECT_EQ(taken_over.load_changes.front().begin, 300U);
  // Slings lean: the one that takes over gains less.
  EXPECT_THAT(judge_beside(times(0.7), times(1.2)).load_changes, SizeIs(1));
  // The other cell has its sign reversed.
  EXPECT_THAT(judge_beside(times(0.7), [&](double t) { return -times(1.3)(t); }).load_changes,
              SizeIs(1));
  const JudgedSamples alone = judge_beside(times(0.7), swing);
  EXPECT_THAT(alone.load_changes, IsEmpty());
  EXPECT_EQ(count_left_out(alone.faults, 601), 300U);
}

// The load becomes lighter; or the amplifier of all cells sets them to zero.
TEST(FaultySamples, AreNoLoadThatChangesForAllRopes) {
  const auto times = [](double factor, double load) {
    return [=](double t) { return load * (t < 29.99 ? 1 : factor) * swing(t); };
  };
  EXPECT_THAT(judge_beside(times(0.8, 1), times(0.8, 1.4)).load_changes, SizeIs(1));
  EXPECT_THAT(judge_beside(times(0.8, 1), times(0.8, 1.4)).faults, IsEmpty());
  EXPECT_THAT(judge_beside(times(0.8, 1), times(0.6, 1.4)).load_changes, IsEmpty());
  EXPECT_THAT(judge_beside(times(0.02, 1), times(0.02, 1.4)).load_changes, IsEmpty());
}

}  // namespace
}  // namespace blocklift::pipeline
