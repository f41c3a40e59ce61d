// Limiting sea states of a lift that is linear in the wave height, which are known by hand.
#include "pipeline/study/limits/limiting_sea.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/limits/figure_limit.h"
#include "pipeline/study/pages/study_json.h"
#include "pipeline/study/results/study_results.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

constexpr double degree = std::numbers::pi / 180;

StudyVariable variable_of(const std::string& name, const Exponents& exponents,
                          const std::vector<double>& values) {
  StudyVariable variable;
  variable.name = {name, {}};
  for (const double value : values) variable.values.push_back({{value, exponents}, {}});
  return variable;
}

/// A load of 100 N at rest; per metre of height a resonance at 8 s, and more from the beam; seed 2
/// gives a tenth more than seed 1. Clearance falls by as many centimetres.
double load_per_metre(double period, double heading) {
  return (10 + 30 / (1 + std::pow(period - 8, 2))) * (1 + std::pow(std::sin(heading), 2));
}

class LinearLift : public ::testing::Test {
 protected:
  LinearLift() {
    study_.design = StudyDesign::grid;
    study_.variables = {
        variable_of("Hs", {1, 0, 0, 0}, {0.5, 1, 2, 4}),
        variable_of("Tp", {0, 0, 1, 0}, {6, 8, 10}),
        variable_of("to", {0, 0, 0, 1}, {0, 90 * degree, 180 * degree, 270 * degree}),
        variable_of("seed", {}, {1, 2})};
    SeaLimits limits;
    limits.height = {"Hs", {}};
    limits.period = {"Tp", {}};
    limits.heading = {"to", {}};
    limits.quantities = {limit("load_N", 160)};
    study_.limits = limits;
    design_ = make_design(study_);
    for (Eigen::Index i = 0; i < design_.rows(); ++i) {
      const double wave = design_(i, 0) * load_per_metre(design_(i, 1), design_(i, 2)) *
                          (design_(i, 3) == 2 ? 1 : 1 / 1.1);
      Member member;
      member.number = static_cast<int>(i);
      member.figures = {{"load_N", 100 + wave}, {"clearance_m", 2 - wave / 100}};
      member.worse_when_smaller = {"clearance_m"};
      members_.push_back(member);
    }
  }
  static QuantityLimit limit(const std::string& path, double value) {
    const Exponents force{1, 1, -2, 0}, length{1, 0, 0, 0};
    return {{path, {}}, {{value, path.ends_with("_N") ? force : length}, {}}};
  }

  StudyFile study_;
  Eigen::MatrixXd design_;
  std::vector<Member> members_;
};

TEST_F(LinearLift, RefusesALimitOfAnotherDimension) {
  study_.limits->quantities = {limit("load_N", 160)};
  study_.limits->quantities[0].at.value.exponents = {0, 1, 0, 0};
  EXPECT_THROW(find_limiting_seas(study_, design_, members_), InputError);
  EXPECT_THROW(check_figure_limits(study_), InputError);
}

TEST_F(LinearLift, HasTheHeightsThatAreKnownByHand) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  ASSERT_EQ(seas.periods.size(), 3U);
  ASSERT_EQ(seas.headings.size(), 4U);
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t h = 0; h < 4; ++h) {
      const double exact = 60 / load_per_metre(seas.periods[p], seas.headings[h]);
      EXPECT_EQ(seas.at(p, h).kind, LimitKind::found);
      EXPECT_NEAR(seas.at(p, h).height, exact, 1e-12 * exact);
    }
  EXPECT_NEAR(seas.at(1, 0).height, 1.5, 1e-12);   // 60 / (10 + 30)
  EXPECT_NEAR(seas.at(1, 1).height, 0.75, 1e-12);  // twice the load from the beam
}

TEST_F(LinearLift, TheFirstLimitCounts) {
  study_.limits->quantities.push_back(limit("clearance_m", 1.7));  // a wave load of 30 N
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  EXPECT_NEAR(seas.at(1, 0).height, 0.75, 1e-12);
  EXPECT_EQ(seas.governing.front(), "clearance_m");
  study_.limits->quantities = {limit("nothing", 1)};
  EXPECT_THROW(find_limiting_seas(study_, design_, members_), std::runtime_error);
}

TEST_F(LinearLift, SaysWhereTheGridDoesNotHoldTheLimit) {
  study_.limits->quantities = {limit("load_N", 1000)};
  EXPECT_EQ(find_limiting_seas(study_, design_, members_).at(0, 0).kind, LimitKind::above_grid);
  study_.limits->quantities = {limit("load_N", 101)};
  const LimitingSeas low = find_limiting_seas(study_, design_, members_);
  EXPECT_EQ(low.at(0, 0).kind, LimitKind::below_grid);
  EXPECT_EQ(low.at(0, 0).height, 0);
  // A member that failed ends the heights that are known.
  study_.limits->quantities = {limit("load_N", 1000)};
  for (Member& member : members_)
    if (design_(member.number, 0) == 4) member.figures.clear();
  const LimitingSeas failed = find_limiting_seas(study_, design_, members_);
  EXPECT_EQ(failed.at(0, 0).kind, LimitKind::before_failure);
  EXPECT_EQ(failed.at(0, 0).height, 2);
  EXPECT_EQ(failed.governing.front(), "");
  EXPECT_EQ(failed.failed.front(), 72);  // the highest of four heights of 24 members each
}

// Where the lowest sea could not be computed no quantity reached its limit.
TEST_F(LinearLift, KnowsNothingWhereTheLowestSeaFailed) {
  // 0.5 m, 8 s, across, of the second seed.
  const int lost = 11;
  ASSERT_EQ(design_.row(lost), Eigen::RowVector4d(0.5, 8, 90 * degree, 2));
  members_[lost].figures.clear();
  members_[lost].failure = "no equilibrium";
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  EXPECT_EQ(seas.at(1, 1).kind, LimitKind::unknown);
  EXPECT_EQ(seas.at(1, 1).height, 0);
  EXPECT_EQ(seas.governing[5], "");
  EXPECT_EQ(seas.failed[5], lost);
  EXPECT_EQ(seas.failed[4], -1);
  EXPECT_THAT(limiting_text(seas), ::testing::HasSubstr("unknown"));
  EXPECT_THAT(
      sentences_of_failures(seas),
      ::testing::ElementsAre("8 s, 90°: not known, member 11 failed; it counts as not workable"));
  // Nor between it and its neighbours; what does not need it stays.
  EXPECT_EQ(seas.height_at(8, 45 * degree), 0);
  EXPECT_EQ(seas.height_at(7, 90 * degree), 0);
  EXPECT_NEAR(seas.height_at(8, 0), 1.5, 1e-12);
  // What is not known is no number in the file, either.
  const auto json = study_json(evaluate_study(study_, design_, members_));
  const auto& states = json["limits"]["sea_states"];
  EXPECT_EQ(states[5]["known_as"], "unknown");
  EXPECT_TRUE(states[5]["significant_height_m"].is_null());
  EXPECT_TRUE(states[5]["alpha"].is_null());
  EXPECT_EQ(states[4]["alpha"], 1);
}

TEST_F(LinearLift, WorksAsOftenAsTheTableHasSuchSeas) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  // Half way between headings and periods the limit is the mean; headings go round.
  EXPECT_NEAR(seas.height_at(8, 45 * degree), (1.5 + 0.75) / 2, 1e-12);
  EXPECT_NEAR(seas.height_at(8, 315 * degree), (1.5 + 0.75) / 2, 1e-12);
  EXPECT_NEAR(seas.height_at(8, -45 * degree), (1.5 + 0.75) / 2, 1e-12);
  EXPECT_EQ(seas.height_at(12, 0), 0);
  const std::vector<SeaState> scatter = {
      {1.0, 8, 0, 30, 0}, {1.0, 8, 90 * degree, 20, 0}, {1.2, 8, 0, 40, 0}, {0.2, 12, 0, 10, 0}};
  const Operability all = find_operability(seas, scatter, 1, false);
  EXPECT_NEAR(all.share, 0.7, 1e-12);
  EXPECT_NEAR(all.beyond_periods, 0.1, 1e-12);
  EXPECT_NEAR(find_operability(seas, scatter, 0.71, false).share, 0.3, 1e-12);  // up to 1.065 m
  const std::vector<SeaState> forecast = {{1.0, 8, 0, 0, 0},
                                          {1.2, 8, 0, 3, 3},
                                          {1.6, 8, 0, 6, 6},
                                          {1.4, 8, 0, 9, 9},
                                          {1, 8, 0, 12, 12}};
  const Operability ahead = find_operability(seas, forecast, 1, true);
  EXPECT_NEAR(ahead.share, 0.8, 1e-12);
  ASSERT_EQ(ahead.windows.size(), 2U);
  EXPECT_EQ(ahead.windows[0].end, 3);
  EXPECT_EQ(ahead.windows[1].begin, 9);
  EXPECT_EQ(ahead.windows[1].end, 12);
}

// By hand: along, 1.5 m is borne and alpha 0.7, across 0.75 m and 0.5.
TEST_F(LinearLift, AlphaIsThatOfTheLimitingHeight) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const AlphaFactor alpha({1, 2}, {0.5, 0.9}, 24, 20);
  const std::vector<SeaState> scatter = {{1.04, 8, 0, 10, 0},
                                         {1.06, 8, 0, 20, 0},
                                         {0.37, 8, 90 * degree, 30, 0},
                                         {0.38, 8, 90 * degree, 40, 0}};
  const Operability found = find_operability(seas, scatter, alpha, false);
  EXPECT_NEAR(found.share, 0.4, 1e-12);
  EXPECT_THAT(sentences_of_scatter(found, alpha).front(),
              ::testing::HasSubstr("40.0 % is workable with alpha from 0.5 to 0.9"));
}

TEST_F(LinearLift, TellsTheWindowsThatHoldThePlan) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const std::vector<SeaState> forecast = {{1, 8, 0, 0, 0},   {1, 8, 0, 6, 6},   {1.5, 8, 0, 12, 12},
                                          {1, 8, 0, 18, 18}, {1, 8, 0, 24, 24}, {1, 8, 0, 30, 30}};
  const auto second_sentence = [&](double planned) {
    const AlphaFactor alpha({1, 2}, {0.6, 0.8}, 24, planned);  // 0.7, and 1.05 m
    return sentences_of_forecast(find_operability(seas, forecast, alpha, true), alpha)[1];
  };
  EXPECT_EQ(second_sentence(12),
            "windows that last the 12 h that the operation is planned for: 18 h to 30 h");
  EXPECT_EQ(second_sentence(12.5), "no window lasts the 12.5 h that the operation is planned for");
}

// A window has to last plan and contingency: 12 h hold 8 h and 4 h, and no more.
TEST_F(LinearLift, AWindowLastsTheContingencyToo) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const std::vector<SeaState> forecast = {{1.5, 8, 0, 0, 0},
                                          {1, 8, 0, 6, 6},
                                          {1, 8, 0, 12, 12},
                                          {1, 8, 0, 18, 18},
                                          {1.5, 8, 0, 24, 24}};
  const auto second_sentence = [&](double contingency) {
    const AlphaFactor alpha({1, 2}, {0.6, 0.8}, 12, 8, contingency);
    return sentences_of_forecast(find_operability(seas, forecast, alpha, true), alpha)[1];
  };
  EXPECT_EQ(second_sentence(4),
            "windows that last the 12 h of the operation, 8 h planned and 4 h of contingency: 6 h "
            "to 18 h");
  EXPECT_EQ(second_sentence(6),
            "no window lasts the 14 h of the operation, 8 h planned and 6 h of contingency");
}

// A calm sea that was not run, or beside a limit that is not known, is told as not workable: it
// does not count as workable.
TEST_F(LinearLift, ACalmSeaThatWasNotRunIsNotAllowed) {
  LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const std::vector<SeaState> calm = {{0, 8, 0, 60, 0}, {0, 12, 0, 40, 0}};
  const Operability found = find_operability(seas, calm, 1, false);
  EXPECT_NEAR(found.share, 0.6, 1e-12);
  EXPECT_NEAR(found.beyond_periods, 0.4, 1e-12);
  seas.heights[1 * 4 + 0] = {0, LimitKind::unknown};
  EXPECT_EQ(find_operability(seas, calm, 1, false).share, 0);
  seas.heights[1 * 4 + 0] = {0, LimitKind::below_grid};
  EXPECT_EQ(find_operability(seas, calm, 1, false).share, 0);
}

// What a window that reaches the last instant does behind it nobody knows.
TEST_F(LinearLift, SaysWhereAForecastEndsInAWindow) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const auto sentences = [&](double last_height) {
    const std::vector<SeaState> forecast = {
        {1, 8, 0, 0, 0}, {1, 8, 0, 3, 3}, {last_height, 8, 0, 6, 6}};
    return sentences_of_forecast(find_operability(seas, forecast, 1, true), 1);
  };
  EXPECT_THAT(sentences(1), ::testing::ElementsAre(
                                ::testing::HasSubstr("windows: 0 h to 6 h"),
                                "the last window reaches the end of the forecast, 6 h: how long it "
                                "lasts is not known"));
  EXPECT_THAT(sentences(2), ::testing::ElementsAre(::testing::HasSubstr("windows: 0 h to 3 h")));
}

// Half a day without a forecast is no part of a window, whatever the sea is before and behind.
TEST_F(LinearLift, WindowsEndWhereAForecastHasAHole) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const auto calm_at = [](const std::vector<double>& times) {
    std::vector<SeaState> states;
    for (const double time : times) states.push_back({1, 8, 0, 0, time});
    return states;
  };
  const Operability ahead = find_operability(seas, calm_at({0, 6, 100, 106}), 1, true);
  ASSERT_EQ(ahead.windows.size(), 2U);
  EXPECT_EQ(ahead.windows[0].end, 6);
  EXPECT_EQ(ahead.windows[1].begin, 100);
  ASSERT_EQ(ahead.holes.size(), 1U);
  EXPECT_THAT(sentences_of_forecast(ahead, 1),
              ::testing::ElementsAre(
                  "forecast: 100.0 % of its instants are workable with alpha 1; windows: 0 h to 6 "
                  "h; 100 h to 106 h",
                  ::testing::HasSubstr("reaches the end of the forecast, 106 h"),
                  ::testing::HasSubstr("no instants in 6 h to 100 h")));
  // A step left out is none yet.
  EXPECT_EQ(find_operability(seas, calm_at({0, 6, 18, 24}), 1, true).windows.size(), 1U);
  // Of two steps the shorter one is the usual one.
  EXPECT_EQ(find_operability(seas, calm_at({0, 6, 100}), 1, true).windows.size(), 2U);
}

TEST_F(LinearLift, SaysWhichHeadingsWereNotRun) {
  LimitingSeas half = find_limiting_seas(study_, design_, members_);
  half.headings = {0, 60 * degree, 120 * degree, 180 * degree};
  const std::vector<SeaState> scatter = {
      {0.1, 8, 0, 15, 0}, {0.1, 8, 270 * degree, 30, 0}, {0.1, 12, 225 * degree, 15, 0}};
  const Operability found = find_operability(half, scatter, 1, false);
  EXPECT_NEAR(found.share, 0.25, 1e-12);
  EXPECT_NEAR(found.beyond_headings, 0.75, 1e-12);
  EXPECT_NEAR(found.beyond_periods, 0.25, 1e-12);
  EXPECT_THAT(sentences_of_scatter(found, 1),
              ::testing::ElementsAre(::testing::HasSubstr("75.0 % has headings that were not run"),
                                     ::testing::HasSubstr("add up to 60")));
}

TEST_F(LinearLift, IsDrawn) {
  const LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  EXPECT_THAT(limiting_contours(seas), ::testing::HasSubstr("<path d=\"M"));
  const std::string round = limiting_polar(seas);
  EXPECT_THAT(round, ::testing::HasSubstr("Tp 8 s"));
  // A curve a period, each closed.
  EXPECT_THAT(round, ::testing::ContainsRegex("<path d=\"M[^\"]*Z\" stroke"));
  EXPECT_THAT(round, ::testing::Not(::testing::HasSubstr("fill=\"#fff\"")));
  // From 0 to 180 degrees there is a way round that was not run, and limits that are not known.
  LimitingSeas half = seas;
  half.headings = {0, 60 * degree, 120 * degree, 180 * degree};
  half.heights[0].kind = LimitKind::above_grid;
  const std::string open = limiting_polar(half);
  EXPECT_THAT(open, ::testing::Not(::testing::ContainsRegex("<path d=\"M[^\"]*Z\" stroke")));
  EXPECT_THAT(open, ::testing::HasSubstr("fill=\"#fff\""));
}

/// Places of the first curve of a drawing round the compass: heading, and distance from the middle
/// of the rose, in points.
std::vector<std::pair<double, double>> places_of_first_curve(const std::string& svg) {
  const std::size_t begin = svg.find("<path d=\"M") + 10;
  std::string numbers = svg.substr(begin, svg.find('"', begin) - begin);
  for (char& c : numbers)
    if (c == 'L' || c == 'Z') c = ' ';
  std::istringstream stream(numbers);
  std::vector<std::pair<double, double>> places;
  for (double x = 0, y = 0; stream >> x >> y;)
    places.emplace_back(std::atan2(162 - y, x - 150), std::hypot(x - 150, 162 - y));
  return places;
}

// Between two headings the limit is linear over the heading: where it is the same all round the
// curve is a circle, which chords between headings 90 degrees apart would cut to 0.71 of it.
TEST_F(LinearLift, IsDrawnRoundTheCompassAsItCountsBetweenHeadings) {
  LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  const double last_digit = 0.1;  // of places
  const auto places = places_of_first_curve(limiting_polar(seas));
  ASSERT_EQ(places.size(), 120U);
  const double scale = places.front().second / seas.at(0, 0).height;
  for (const auto& [heading, distance] : places)
    EXPECT_NEAR(distance, scale * seas.height_at(6, heading), last_digit + scale * 2e-3);
  for (LimitingHeight& limit : seas.heights) limit.height = 2;
  for (const auto& [heading, distance] : places_of_first_curve(limiting_polar(seas)))
    EXPECT_NEAR(distance, 112, last_digit);
}

// A chart over periods needs two of them.
TEST_F(LinearLift, OfOnePeriodIsDrawnRoundTheCompassAlone) {
  LimitingSeas seas = find_limiting_seas(study_, design_, members_);
  seas.periods.resize(1);
  EXPECT_EQ(limiting_contours(seas), "");
  EXPECT_THAT(limiting_polar(seas), ::testing::HasSubstr("Tp 6 s"));
  seas.headings.resize(1);
  EXPECT_EQ(limiting_contours(seas), "");
  EXPECT_EQ(limiting_polar(seas), "");
}

// Where the lowest sea is too much everywhere nothing is left to draw but the rose.
TEST_F(LinearLift, IsDrawnWhereNothingIsAllowed) {
  study_.limits->quantities = {limit("load_N", 101)};
  const std::string polar = limiting_polar(find_limiting_seas(study_, design_, members_));
  EXPECT_THAT(polar, ::testing::Not(::testing::HasSubstr("nan")));
  EXPECT_THAT(polar, ::testing::Not(::testing::HasSubstr("r=\"-")));
}

TEST(SeaStates, AreReadWithTheirHeads) {
  const test::TemporaryFolder folder;
  folder.write("scatter.csv",
               "significant_height_m,peak_period_s,heading_deg,share\n0.5,6,90,12\n1,8,180,3\n");
  const std::vector<SeaState> states = read_sea_states("scatter.csv", false, true);
  ASSERT_EQ(states.size(), 2U);
  EXPECT_NEAR(states[1].heading, std::numbers::pi, 1e-12);
  EXPECT_EQ(states[0].share, 12);
  EXPECT_THROW(read_sea_states("scatter.csv", true, true), InputError);  // no time_h, and a share
  folder.write("scatter.csv", "significant_height_m,peak_period_s,share\n-1,6,1\n");
  EXPECT_THROW(read_sea_states("scatter.csv", false, false), InputError);
  EXPECT_THROW(read_sea_states("none.csv", false, false), InputError);
}

TEST(SeaStates, NeedAHeadingWhereTheLimitsHaveSeveral) {
  const test::TemporaryFolder folder;
  folder.write("scatter.csv", "# a bay\nsignificant_height_m,peak_period_s,share\n1,6,1\n");
  EXPECT_EQ(read_sea_states("scatter.csv", false, false).size(), 1U);
  const auto refusal = [] {
    try {
      read_sea_states("scatter.csv", false, true);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(),
              ::testing::HasSubstr("scatter.csv:2:1: error: there is no column heading_deg"));
  folder.write("scatter.csv",
               "significant_height_m,peak_period_s,heading_deg,share,share\n1,6,0,1,9\n");
  EXPECT_THAT(refusal(),
              ::testing::HasSubstr("scatter.csv:1:1: error: the column \"share\" is there twice"));
}

}  // namespace
}  // namespace blocklift::pipeline
