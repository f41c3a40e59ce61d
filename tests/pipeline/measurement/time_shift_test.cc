#include "pipeline/measurement/time_shift.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

TimeSeries series_of(double from, double to, double step,
                     const std::function<double(double)>& value) {
  TimeSeries series;
  for (int i = 0; from + i * step <= to; ++i) {
    series.time.push_back(from + i * step);
    series.values.push_back(value(series.time.back()));
  }
  return series;
}

/// A load that is taken over at 20 s and sways then.
double taken_over(double t) {
  return t < 20 ? 10 : 100 + 15 * std::exp(-0.05 * (t - 20)) * std::sin(1.3 * (t - 20));
}

TEST(FindTimeShift, FindsAKnownShiftWhateverZeroAndScaleOfTheCell) {
  const double shift = 37.234;  // a record's clock that stands behind
  const TimeSeries computed = series_of(0, 80, 0.05, taken_over);
  const TimeSeries measured =
      series_of(-30, 30, 0.1, [&](double t) { return 7 + 1.3 * taken_over(t + shift); });
  const auto found = find_time_shift({{measured, computed}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->shift, shift, 0.02);
  EXPECT_GT(found->correlation, 0.999);
  EXPECT_FALSE(found->is_doubtful());
}

TEST(FindTimeShift, BearsNoiseOnSeveralChannels) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 8);
  const TimeSeries computed = series_of(0, 80, 0.05, taken_over);
  std::vector<ChannelPair> channels;
  for (int k = 0; k < 3; ++k)
    channels.push_back(
        {series_of(0, 60, 0.1, [&](double t) { return taken_over(t + 11.4) + noise(random); }),
         computed});
  const auto found = find_time_shift(channels);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->shift, 11.4, 0.05);
}

// Cells that begin to speak and fall silent at instants of their own.
TEST(FindTimeShift, TakesChannelsThatBeginAndEndElsewhere) {
  const TimeSeries computed = series_of(0, 80, 0.05, taken_over);
  const auto measured = [&](double from, double to) {
    return series_of(from, to, 0.1, [](double t) { return taken_over(t + 11.4); });
  };
  const auto found = find_time_shift({{measured(0, 60), computed},
                                      {measured(3, 25), computed},
                                      {measured(5, 66), samples_in(computed, {10, 80})}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->shift, 11.4, 0.05);
}

TEST(FindTimeShift, DoubtsWhatEveryPeriodWouldDo) {
  const auto wave = [](double t) { return std::sin(t); };
  const auto found = find_time_shift({{series_of(0, 30, 0.1, wave), series_of(0, 60, 0.1, wave)}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_doubtful());
}

TEST(FindTimeShift, HasNothingToSayOfAConstant) {
  const auto constant = [](double) { return 5.0; };
  EXPECT_FALSE(
      find_time_shift({{series_of(0, 30, 0.1, constant), series_of(0, 60, 0.1, taken_over)}}));
}

}  // namespace
}  // namespace blocklift::pipeline
