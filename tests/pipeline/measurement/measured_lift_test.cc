#include "pipeline/measurement/measured_lift.h"

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/measurement/measured_tables.h"
#include "tests/pipeline/measurement/sample_record.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Cells of a sample lift whose clock stands 123.4 s ahead; R1's scale is 3 % too large.
class MeasuredLifts : public ::testing::Test {
 protected:
  MeasuredLifts() {
    test::write_sample_lift("lift");
    std::string cells = "time [s],ropes.R1 [kN],ropes.R2 [t]\n";
    for (int i = 0; i <= 500; ++i) {
      const double t = 5 + 0.1 * i;
      const double tension = test::sample_tension(t);
      cells += fmt::format("{:.3f},{:.9g},{:.9g}\n", t + 123.4, 1.03 * tension / 1000,
                           tension / 1.5 / 9806.65);
    }
    folder_.write("cells.csv", cells);
  }

  static MeasuredLift hold(const MeasurementSettings& settings = {}) {
    return hold_against_measurements("lift", {"cells.csv"}, settings);
  }
  static std::string refusal_of(const MeasurementSettings& settings,
                                const std::vector<std::filesystem::path>& records = {"cells.csv"}) {
    try {
      hold_against_measurements("lift", records, settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  const test::TemporaryFolder folder_;
};

TEST_F(MeasuredLifts, SayWhereCellsAreSilent) {
  std::string cells = "time;ropes.R1 [kN];ropes.R2 [t]\n";
  for (int i = 0; i <= 500; ++i) {
    const double t = 5 + 0.1 * i;
    const bool is_silent = i > 100 && i < 150;
    cells +=
        fmt::format("2026-05-04 10:{:02}:{:06.3f};{:.9g};{}\n", i / 600, 0.1 * (i % 600),
                    test::sample_tension(t) / 1000,
                    is_silent ? "" : fmt::format("{:.9g}", test::sample_tension(t) / 14709.975));
  }
  folder_.write("cells.csv", cells);
  const MeasuredLift lift = hold();
  EXPECT_NEAR(lift.records.at(0).shift, 5, 2e-3);
  EXPECT_THAT(lift.doubts, ElementsAre("ropes.R2 has nothing from 15.0 s to 20.0 s"));
  ASSERT_TRUE(lift.channels[1].agreement);
  EXPECT_EQ(lift.channels[1].agreement->samples, 501u - 49u);
}

TEST_F(MeasuredLifts, AreAlignedAndCompared) {
  const MeasuredLift lift = hold();
  EXPECT_NEAR(lift.records.at(0).shift, -123.4, 2e-3);
  EXPECT_THAT(lift.doubts, IsEmpty());
  ASSERT_EQ(lift.channels.size(), 2u);
  ASSERT_TRUE(lift.channels[0].agreement && lift.channels[0].agreement->scale);
  EXPECT_NEAR(*lift.channels[0].agreement->scale, 1.03, 1e-4);
  EXPECT_NEAR(*lift.channels[1].agreement->scale, 1, 1e-4);
  EXPECT_NEAR(lift.channels[1].agreement->rms_difference, 0, 10);
  const Agreement& first = *lift.channels[0].agreement;
  EXPECT_NEAR(first.largest_measured / first.largest_computed, 1.03, 1e-4);
  // The swing is 5 % less what it decays in a quarter of a period, whatever the cell's scale.
  const double amplification = 1 + 0.05 * std::exp(-0.01 * std::acos(-1.0) / 2);
  EXPECT_NEAR(first.computed_amplification(), amplification, 1e-5);
  EXPECT_NEAR(first.measured_amplification(), amplification, 1e-4);
  ASSERT_TRUE(lift.channels[0].sharing);
  EXPECT_NEAR(lift.channels[0].sharing->measured, 0.6 * 1.03 / (0.6 * 1.03 + 0.4), 1e-4);
  EXPECT_NEAR(lift.channels[0].sharing->computed, 0.6, 1e-9);
}

TEST_F(MeasuredLifts, TakeAShiftThatIsGiven) {
  MeasurementSettings settings;
  settings.shifts = {-120};
  const MeasuredLift lift = hold(settings);
  EXPECT_EQ(lift.records.at(0).shift, -120);
  EXPECT_FALSE(lift.records.at(0).found);
  EXPECT_LT(lift.channels[1].agreement->correlation, 0.9);
}

TEST_F(MeasuredLifts, HaveTheirPeriodAndDampingIdentified) {
  MeasurementSettings settings;
  settings.decay = TimeWindow{12, 50};
  const MeasuredLift lift = hold(settings);
  for (const auto& decay : {lift.channels[0].measured_decay, lift.channels[0].computed_decay}) {
    ASSERT_TRUE(decay);
    // e^(-0.01 w t) sin(w t) with w = 2 pi / 4 s: the ratio is 0.01 / sqrt(1 + 0.01^2).
    EXPECT_NEAR(decay->period, 4, 1e-4);
    EXPECT_NEAR(decay->damping_ratio, 0.01, 1e-5);
  }
}

// A swing that grows is no free one: two that beat, or one that is driven.
TEST_F(MeasuredLifts, DoubtADampingBelowZero) {
  std::string cells = "time [s],ropes.R1 [kN]\n";
  for (int i = 0; i <= 500; ++i) {
    const double t = 5 + 0.1 * i;
    const double swing = std::exp(0.003 * (t - 12)) * std::sin(std::acos(-1.0) / 2 * (t - 10));
    cells += fmt::format("{:.3f},{:.9g}\n", t, 47 * (1 + 0.05 * (t < 10 ? 0 : swing)));
  }
  folder_.write("cells.csv", cells);
  MeasurementSettings settings;
  settings.shifts = {0};
  settings.decay = TimeWindow{12, 50};
  EXPECT_THAT(hold(settings).doubts,
              ElementsAre(HasSubstr("more than one oscillation is in ropes.R1")));
}

TEST_F(MeasuredLifts, SayWhereNothingSwings) {
  MeasurementSettings settings;
  settings.decay = TimeWindow{5.5, 9.5};
  EXPECT_THAT(hold(settings).doubts, ElementsAre(HasSubstr("from 5.5 s to 9.5 s")));
}

TEST_F(MeasuredLifts, AreWeighed) {
  MeasurementSettings settings;
  settings.rest = TimeWindow{5, 10};
  settings.cell_accuracy = 0.01;
  const MeasuredLift lift = hold(settings);
  ASSERT_TRUE(lift.weight);
  const Weighing& weighing = lift.weight->measured;
  // R1 bears 60 % of 8 t, of which its cell shows 3 % more.
  EXPECT_NEAR(weighing.mass, 8000 * (0.6 * 1.03 + 0.4), 1e-3);
  EXPECT_NEAR(weighing.mass_deviation, 80 * std::hypot(0.6 * 1.03, 0.4), 1e-3);
  EXPECT_NEAR(weighing.centre_of_mass_B.y(), 4 * (0.618 - 0.4) / 1.018, 1e-6);
  EXPECT_NEAR(weighing.centre_of_mass_B.x(), 0, 1e-9);
  ASSERT_TRUE(weighing.open_direction_B);
  EXPECT_NEAR(std::abs(weighing.open_direction_B->z()), 1, 1e-12);
  // What the block's file says.
  EXPECT_EQ(lift.weight->computed_mass, 8000);
  ASSERT_TRUE(lift.weight->computed_centre_B);
  EXPECT_EQ(*lift.weight->computed_centre_B, Eigen::Vector3d(0, 0.8, 0.25));
  // The measured ones are those of the plumb line at the computed height.
  EXPECT_NEAR(weighing.centre_of_mass_B.z(), 0.25, 1e-12);
}

// A dead cell, a reversed one, one in another unit, and one that shows something else.
TEST_F(MeasuredLifts, DoubtChannelsThatAreNotTheComputedOnes) {
  const auto doubts_of = [&](const std::string& unit, const auto& reading) {
    std::string cells = "time [s],ropes.R1 [kN],ropes.R2 [" + unit + "]\n";
    for (int i = 0; i <= 500; ++i) {
      const double t = 5 + 0.1 * i, tension = test::sample_tension(t) / 1000;
      cells += fmt::format("{:.3f},{:.9g},{:.9g}\n", t, tension, reading(t, tension / 1.5));
    }
    folder_.write("cells.csv", cells);
    MeasurementSettings settings;
    settings.shifts = {0};
    settings.rest = TimeWindow{5, 10};
    return hold(settings).doubts;
  };
  const auto is_in = HasSubstr("made of doubtful channels, too: ropes.R2");
  EXPECT_THAT(doubts_of("kN", [](double, double) { return 20.0; }),
              ElementsAre(HasSubstr("ropes.R2 is 20000 N at every instant"), is_in));
  EXPECT_THAT(doubts_of("N", [](double, double tension) { return tension; }),
              ElementsAre(HasSubstr("ropes.R2 moves 0.001 times as much"), is_in));
  EXPECT_THAT(doubts_of("kN", [](double, double tension) { return -tension; }),
              ElementsAre(HasSubstr("correlation is -1.00: its sign may be reversed"), is_in));
  EXPECT_THAT(doubts_of("kN", [](double t, double) { return 31 + std::sin(7.3 * t); }),
              ElementsAre(HasSubstr("ropes.R2 does not follow the computed one"), is_in));
  EXPECT_THAT(doubts_of("kN", [](double, double tension) { return 1.9 * tension; }), IsEmpty());
  EXPECT_THAT(doubts_of("kN", [](double, double tension) { return tension + 40; }),
              ElementsAre(HasSubstr("times the computed one on average"), is_in));
  EXPECT_THAT(doubts_of("kN", [](double t,
                                 double tension) { return std::abs(t - 20) < 0.01 ? 0 : tension; }),
              ElementsAre(HasSubstr("ropes.R2: 1 of 501 samples are left out (0.2 %): a spike")));
}

// Before 10 s nothing moves, and after it a twentieth: noise of a tenth hides that.
TEST_F(MeasuredLifts, DoubtNoSoundCellForItsNoise) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.1);
  std::string cells = "time [s],ropes.R1 [kN],ropes.R2 [kN]\n";
  for (int i = 0; i <= 500; ++i) {
    const double t = 5 + 0.1 * i, tension = test::sample_tension(t) / 1000;
    cells += fmt::format("{:.3f},{:.9g},{:.9g}\n", t, tension * (1 + noise(random)),
                         tension / 1.5 * (1 + noise(random)));
  }
  folder_.write("cells.csv", cells);
  MeasurementSettings settings;
  settings.shifts = {0};
  settings.rest = TimeWindow{5, 10};
  const MeasuredLift lift = hold(settings);
  EXPECT_LT(lift.channels[0].agreement->correlation, 0.7);
  EXPECT_LT(lift.channels[1].agreement->correlation, 0.7);
  EXPECT_THAT(lift.doubts, IsEmpty());
}

TEST_F(MeasuredLifts, AreRefusedWhereSettingsDoNotFit) {
  MeasurementSettings settings;
  settings.rest = TimeWindow{500, 600};
  EXPECT_THAT(refusal_of(settings),
              HasSubstr("--rest 500:600: error: the records of all ropes have less"));
  settings = {};
  settings.shifts = {1, 2};
  EXPECT_THAT(refusal_of(settings), HasSubstr("there are 2 shifts for 1 records"));
  folder_.write("one.csv", "time [s],ropes.R1 [kN]\n0,1\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n");
  settings = {};
  EXPECT_THAT(refusal_of(settings, {"one.csv"}), HasSubstr("one.csv: error: nothing in this"));
  settings.shifts = {0};
  settings.rest = TimeWindow{0, 7};
  EXPECT_THAT(refusal_of(settings, {"one.csv"}), HasSubstr("what lacks is ropes.R2"));
  EXPECT_THROW(parse_window("--rest", "7"), InputError);
  EXPECT_THROW(parse_window("--rest", "7:a"), InputError);
  EXPECT_THROW(parse_window("--rest", "7:7"), InputError);
  EXPECT_EQ(parse_window("--rest", "-7:7.5").to, 7.5);
}

TEST_F(MeasuredLifts, AreShownInEightyColumnsAsJsonAndAsAPage) {
  folder_.write("wind.csv",
                "time [s],wind.speed [m/s],waves.elevation [m]\n0,8,0\n2,8,1\n4,12,0\n6,12,-1\n"
                "8,12,0\n10,8,1\n12,8,0\n14,8,-1\n16,8,0\n");
  MeasurementSettings settings;
  settings.decay = TimeWindow{12, 50};
  settings.rest = TimeWindow{5, 10};
  const MeasuredLift lift = hold_against_measurements("lift", {"cells.csv", "wind.csv"}, settings);
  const std::string text = measured_text(lift);
  EXPECT_THAT(text, AllOf(HasSubstr("ropes.R1"), HasSubstr("mass t"), HasSubstr("damping %"),
                          HasSubstr("-123.400"), HasSubstr("significant height"),
                          HasSubstr("x m at z = 0.250 m"), HasSubstr("stays open")));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  const nlohmann::ordered_json json = measured_json(lift);
  EXPECT_NEAR(json["records"][0]["shift_s"].get<double>(), -123.4, 2e-3);
  EXPECT_NEAR(json["weight"]["mass_kg"].get<double>(), 8144, 1e-3);
  EXPECT_TRUE(json["weight"]["centre_deviation_m"][1].is_number());
  EXPECT_TRUE(json["weight"]["centre_deviation_m"][2].is_null());
  EXPECT_EQ(json["weight"]["open_coordinate"], "z");
  EXPECT_EQ(json["weight"]["open_coordinate_is_computed"], true);
  EXPECT_NEAR(json["weight"]["centre_of_mass_m"][2].get<double>(), 0.25, 1e-12);
  EXPECT_EQ(json["channels"][0]["name"], "ropes.R1");
  EXPECT_EQ(json["wind"]["computed_mean_m_s"], 8);
  EXPECT_EQ(json["waves"]["computed_significant_height_m"], 0.5);
  const std::string page = measured_page(lift);
  EXPECT_THAT(page, AllOf(HasSubstr("<h1>Measured and computed</h1>"), HasSubstr("ropes.R1"),
                          HasSubstr("y m at z = 0.250 m"), Not(HasSubstr("%HEADING%"))));
}

// A record of what was computed differs by rounding alone, which is no difference.
TEST(MeasuredTables, ShowNoRounding) {
  MeasuredLift lift;
  HeldChannel& channel = lift.channels.emplace_back();
  channel.name = "R1";
  channel.unit = "N";
  channel.agreement.emplace();
  channel.agreement->largest_measured = channel.agreement->largest_computed = 1e6;
  channel.agreement->mean_difference = 1e-7;
  channel.agreement->peak_difference = 2;
  for (const MeasuredTable& table : measured_tables(lift)) {
    if (table.caption != "Measured less computed") continue;
    EXPECT_EQ(std::get<double>(table.rows.at(0).at(2)), 0);
    EXPECT_DOUBLE_EQ(std::get<double>(table.rows.at(0).at(4)), 2e-3);
    return;
  }
  FAIL() << "there is no table of differences";
}

TEST(Surroundings, HaveMeanGustHeightAndPeriod) {
  TimeSeries wind{{0, 2, 2.001, 8, 8.001, 16}, {8, 8, 12, 12, 8, 8}};
  EXPECT_NEAR(wind_of(wind).mean, (8 * 10 + 12 * 6) / 16.0, 1e-3);
  EXPECT_NEAR(wind_of(wind).gust, 12, 1e-3);
  TimeSeries waves;
  for (int i = 0; i <= 4000; ++i) {
    waves.time.push_back(0.02 * i);
    waves.values.push_back(0.5 + 1.5 * std::sin(2 * 3.14159265358979 * waves.time.back() / 8));
  }
  EXPECT_NEAR(waves_of(waves).significant_height, 4 * 1.5 / std::sqrt(2.0), 1e-3);
  ASSERT_TRUE(waves_of(waves).zero_crossing_period);
  EXPECT_NEAR(*waves_of(waves).zero_crossing_period, 8, 1e-3);
}

// A buoy samples a wave a few times: over whole periods the sum of the squares of a sine's samples
// is half of their number, however few they are beyond two a period.
TEST(Surroundings, HeightIsThatOfCoarseSamplesToo) {
  for (const int per_period : {3, 5, 12}) {
    TimeSeries waves;
    for (int i = 0; i <= 20 * per_period; ++i) {
      waves.time.push_back(6.0 * i / per_period);
      waves.values.push_back(0.5 * std::sin(2 * std::numbers::pi * i / per_period));
    }
    EXPECT_NEAR(waves_of(waves).significant_height, 4 * 0.5 / std::sqrt(2.0), 1e-9) << per_period;
  }
}

}  // namespace
}  // namespace blocklift::pipeline
