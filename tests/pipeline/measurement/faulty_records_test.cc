// Records of a known lift with what cells, loggers and clocks do to them.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/measurement/measured_lift.h"
#include "tests/pipeline/measurement/sample_record.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double clock_ahead = 123.4, r1_scale = 1.03;

/// Cells of the sample lift from 5 s to 55 s, with noise of 20 N on each; the clock of the record
/// stands ahead, and R1's scale is 3 % too large.
class FaultyRecords : public ::testing::Test {
 protected:
  FaultyRecords() { test::write_sample_lift("lift"); }

  /// @param reading of R1, in kN, at an instant of the lift for what a sound cell would read;
  ///   empty: no value. @param clock of the record for an instant of the lift.
  void write(
      const std::function<std::string(double, double)>& reading,
      const std::function<double(double)>& clock = [](double t) { return t + clock_ahead; }) const {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.02);
    std::string cells = "time [s],ropes.R1 [kN],ropes.R2 [kN]\n";
    for (int i = 0; i <= 500; ++i) {
      const double t = 5 + 0.1 * i, tension = test::sample_tension(t) / 1000;
      const double first = r1_scale * tension + noise(random),
                   second = tension / 1.5 + noise(random);
      const std::string read = reading(t, first);
      cells += fmt::format("{:.4f},{},{:.9g}\n", clock(t), read, second);
    }
    folder_.write("cells.csv", cells);
  }

  static std::string number(double value) { return fmt::format("{:.9g}", value); }
  static bool lies(double t, double from, double to) { return t > from - 0.01 && t < to - 0.01; }

  static MeasuredLift hold(const MeasurementSettings& settings = {}) {
    return hold_against_measurements("lift", {"cells.csv"}, settings);
  }
  static std::string refusal_of(const MeasurementSettings& settings) {
    try {
      hold(settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  /// What the record without faults says of R1.
  static void expect_sound(const MeasuredLift& lift) {
    EXPECT_NEAR(lift.records.at(0).shift, -clock_ahead, 5e-3);
    const HeldChannel& channel = lift.channels.at(0);
    ASSERT_TRUE(channel.agreement && channel.agreement->scale);
    EXPECT_NEAR(*channel.agreement->scale, r1_scale, 5e-3);
    EXPECT_GT(channel.agreement->correlation, 0.999);
    EXPECT_LT(std::abs(channel.agreement->peak_difference), 0.05 * 47e3);
    // The noise is a two thousandth of the load, and the largest of 500 lies three deviations off.
    EXPECT_NEAR(channel.agreement->measured_amplification(),
                channel.agreement->computed_amplification(), 3e-3);
    ASSERT_TRUE(channel.sharing);
    EXPECT_NEAR(channel.sharing->measured, 0.6 * r1_scale / (0.6 * r1_scale + 0.4), 1e-4);
    EXPECT_NEAR(channel.sharing->computed, 0.6, 1e-9);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(FaultyRecords, WithoutFaultsLoseNothing) {
  write([](double, double tension) { return number(tension); });
  const MeasuredLift lift = hold();
  expect_sound(lift);
  EXPECT_THAT(lift.doubts, IsEmpty());
  EXPECT_THAT(lift.channels[0].left_out, IsEmpty());
  EXPECT_EQ(lift.channels[0].samples, 501U);
}

TEST_F(FaultyRecords, LoseTheirZerosAndSpikes) {
  write([](double t, double tension) {
    if (lies(t, 20, 24) || lies(t, 40, 40.1)) return number(0);
    if (lies(t, 30, 30.2)) return number(95);
    return number(tension);
  });
  MeasurementSettings settings;
  settings.decay = TimeWindow{12, 50};
  settings.rest = TimeWindow{5, 10};
  const MeasuredLift lift = hold(settings);
  expect_sound(lift);
  const HeldChannel& channel = lift.channels[0];
  EXPECT_EQ(channel.agreement->samples, 501U - 40U - 1U - 2U);
  ASSERT_EQ(channel.left_out.size(), 3U);
  EXPECT_EQ(channel.left_out[2].fault, Fault::drop_out);
  EXPECT_NEAR(channel.left_out[2].window.from, 20, 0.01);
  EXPECT_NEAR(channel.left_out[2].window.to, 23.9, 0.01);
  EXPECT_THAT(lift.doubts,
              ElementsAre(AllOf(HasSubstr("ropes.R1: 43 of 501 samples are left out (8.6 %)"),
                                HasSubstr("2 spikes, the farthest of"),
                                HasSubstr("leaps away and back from 20.0 s to 23.9 s"))));
  ASSERT_TRUE(channel.measured_decay);
  EXPECT_NEAR(channel.measured_decay->period, 4, 2e-3);
  EXPECT_NEAR(channel.measured_decay->damping_ratio, 0.01, 5e-4);
  ASSERT_TRUE(lift.weight);
  EXPECT_NEAR(lift.weight->measured.mass, 8000 * (0.6 * r1_scale + 0.4), 2);
  const nlohmann::ordered_json json = measured_json(lift);
  EXPECT_EQ(json["channels"][0]["left_out"][2]["as"], "drop_out");
  EXPECT_EQ(json["channels"][0]["left_out"][2]["samples"], 40);
  EXPECT_EQ(json["channels"][0]["samples_of_record"], 501);
}

// Zeros with noise on them, entered and left over a sample half way.
TEST_F(FaultyRecords, LoseAnOpenLinesNoise) {
  write([](double t, double tension) {
    if (lies(t, 30, 30.1) || lies(t, 34, 34.1)) return number(tension / 2);
    return lies(t, 30.1, 34) ? number(0.3 * std::sin(37 * t)) : number(tension);
  });
  const MeasuredLift lift = hold();
  expect_sound(lift);
  EXPECT_EQ(lift.channels[0].agreement->samples, 501U - 41U);
}

TEST_F(FaultyRecords, LoseWhereACellStandsStill) {
  double held = 0;
  write([&](double t, double tension) {
    if (!lies(t, 30.1, 37)) held = tension;
    return number(held);
  });
  const MeasuredLift lift = hold();
  expect_sound(lift);
  ASSERT_EQ(lift.channels[0].left_out.size(), 1U);
  EXPECT_EQ(lift.channels[0].left_out[0].fault, Fault::stuck);
  EXPECT_THAT(lift.doubts, ElementsAre(HasSubstr("stands still while the computed one moves from "
                                                 "30.0 s to 36.9 s")));
}

// Silent for two seconds, then 12 kN too high.
TEST_F(FaultyRecords, LoseTheShorterSideOfARestart) {
  write([](double t, double tension) {
    if (lies(t, 35, 37)) return std::string();
    return number(t > 36 ? tension + 12 : tension);
  });
  MeasurementSettings settings;
  settings.rest = TimeWindow{5, 10};
  const MeasuredLift lift = hold(settings);
  expect_sound(lift);
  ASSERT_EQ(lift.channels[0].left_out.size(), 1U);
  EXPECT_EQ(lift.channels[0].left_out[0].fault, Fault::restart);
  EXPECT_NEAR(lift.channels[0].left_out[0].window.from, 37, 0.01);
  EXPECT_NEAR(lift.channels[0].left_out[0].window.to, 55, 0.01);
  EXPECT_THAT(lift.doubts, ElementsAre(HasSubstr("ropes.R1 has nothing from 34.9 s to 37.0 s"),
                                       HasSubstr("its zero may be another from 37.0 s to 55.0 s")));
  EXPECT_NEAR(lift.weight->measured.mass, 8000 * (0.6 * r1_scale + 0.4), 2);
  settings.rest = TimeWindow{40, 50};
  EXPECT_THAT(refusal_of(settings), HasSubstr("have less than 20 instants in common there"));
}

TEST_F(FaultyRecords, AreRefusedWhereTooLittleIsLeft) {
  write([](double t, double tension) {
    return number(lies(t, 12, 24) || lies(t, 26, 38) || lies(t, 40, 52) ? 0 : tension);
  });
  const MeasuredLift lift = hold();
  EXPECT_NEAR(lift.records.at(0).shift, -clock_ahead, 5e-3);
  EXPECT_TRUE(lift.channels[0].is_refused);
  EXPECT_FALSE(lift.channels[0].agreement);
  EXPECT_FALSE(lift.channels[0].sharing);
  EXPECT_TRUE(lift.channels[1].agreement);
  EXPECT_THAT(lift.doubts, Contains(HasSubstr("Less than half is left: it is held against")));
  EXPECT_EQ(measured_json(lift)["channels"][0]["refused"], true);
  MeasurementSettings settings;
  settings.rest = TimeWindow{5, 10};
  EXPECT_THAT(refusal_of(settings), HasSubstr("what lacks is ropes.R1; less than half of the "
                                              "samples is credible of ropes.R1"));
}

// Most of a rest is silent, or most of a swing.
TEST_F(FaultyRecords, SayWhereTooLittleOfAWindowIsKnown) {
  write([](double t, double tension) {
    return lies(t, 6, 9.5) || lies(t, 20, 40) ? std::string("NaN") : number(tension);
  });
  MeasurementSettings settings;
  settings.rest = TimeWindow{5, 10};
  EXPECT_THAT(refusal_of(settings), HasSubstr("less than half of the time is known of ropes.R1"));
  settings.rest.reset();
  settings.decay = TimeWindow{18, 42};
  const MeasuredLift lift = hold(settings);
  EXPECT_FALSE(lift.channels[0].measured_decay);
  EXPECT_TRUE(lift.channels[1].measured_decay);
  EXPECT_THAT(lift.doubts, Contains(HasSubstr("from 18 s to 42 s is known of ropes.R1: no")));
}

// The record's clock gains half a per cent: uncorrected the period would be 4.02 s.
TEST_F(FaultyRecords, HaveClocksThatRunFast) {
  write([](double, double tension) { return number(tension); },
        [](double t) { return 1.005 * t + clock_ahead; });
  MeasurementSettings settings;
  settings.decay = TimeWindow{12, 50};
  const MeasuredLift lift = hold(settings);
  ASSERT_TRUE(lift.records.at(0).found);
  EXPECT_NEAR(lift.records[0].found->rate, 1 / 1.005 - 1, 3e-4);
  EXPECT_THAT(lift.doubts, ElementsAre(HasSubstr("the clock of cells.csv is 0.5 % fast")));
  ASSERT_TRUE(lift.channels[0].measured_decay);
  EXPECT_NEAR(lift.channels[0].measured_decay->period, 4, 3e-3);
}

TimeSeries series_of(const std::function<double(double)>& value) {
  TimeSeries series;
  for (int i = 0; i <= 600; ++i) {
    series.time.push_back(0.1 * i);
    series.values.push_back(value(series.time.back()));
  }
  return series;
}

// A rope that goes slack within a sample, and is snatched: so it was computed, so it was.
TEST(FaultySamples, AreNotWhatWasComputedToo) {
  const auto slack = [](double t) {
    if (t > 20.05 && t < 23.05) return 0.0;
    if (t > 23.05 && t < 23.15) return 120e3;
    return 47e3 + 2e3 * std::sin(1.57 * t);
  };
  const TimeSeries computed = series_of(slack);
  const TimeSeries measured =
      series_of([&](double t) { return 1.05 * slack(t) + 30 * std::sin(777 * t); });
  EXPECT_FALSE(find_suspects(measured, true).empty());
  EXPECT_TRUE(find_faults(measured, computed, true).empty());
  const TimeSeries steady = series_of([](double t) { return 47e3 + 2e3 * std::sin(1.57 * t); });
  EXPECT_EQ(count_left_out(find_faults(measured, steady, true), measured.size()), 31U);
}

// A cell reads one value as long as its rope is slack, whatever was computed.
TEST(FaultySamples, AreNoRopeThatSlackensByAndBy) {
  const auto taut = [](double t) { return 47e3 + 2e3 * std::sin(1.57 * t); };
  const auto share = [](double t) { return std::clamp((std::abs(t - 30) - 2.5) / 3, 0.0, 1.0); };
  const TimeSeries measured =
      series_of([&](double t) { return share(t) * (taut(t) + 30 * std::sin(777 * t)); });
  EXPECT_FALSE(find_suspects(measured, true).empty());
  EXPECT_TRUE(find_faults(measured, series_of(taut), true).empty());
}

// A load that is taken over within a sample is a jump of both.
TEST(FaultySamples, AreNoLoadThatIsTakenOver) {
  const auto load = [](double t) {
    return t < 25.05 ? 5e3 : 90e3 + 4e3 * std::exp(-0.05 * (t - 25)) * std::sin(1.3 * (t - 25));
  };
  const TimeSeries computed = series_of(load);
  const TimeSeries measured =
      series_of([&](double t) { return 0.8 * load(t) + 30 * std::sin(777 * t); });
  EXPECT_FALSE(find_suspects(measured, true).empty());
  EXPECT_TRUE(find_faults(measured, computed, true).empty());
}

TEST(FaultySamples, AreBetweenSamplesOfWhichNothingIsKnown) {
  const TimeSeries series{{0, 1, 2, 3, 4, 5}, {1, 1, 9, 9, 1, 1}};
  const TimeSeries left = without(series, {{Fault::drop_out, 2, 4, 8}});
  EXPECT_THAT(left.time, ElementsAre(0, 1, 4, 5));
  ASSERT_EQ(gaps_of(left).size(), 1U);
  EXPECT_EQ(gaps_of(left)[0].from, 1);
  EXPECT_EQ(gaps_of(left)[0].to, 4);
  EXPECT_DOUBLE_EQ(known_share(left, {0, 5}), 0.4);
  EXPECT_DOUBLE_EQ(known_share(left, {0, 10}), 0.2);
  EXPECT_EQ(gaps_of(shifted(left, 3))[0].from, 4);
}

}  // namespace
}  // namespace blocklift::pipeline
