#include "pipeline/comparison/summary_figures.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline {
namespace {

TEST(SummaryFigures, KnowWhichAreWorseWhenSmaller) {
  const auto summary = nlohmann::ordered_json::parse(R"({
    "measures": [
      {"name": "load to ground: clearance", "extreme": "smallest", "dynamic": 1.9},
      {"name": "load: tilt", "extreme": "largest", "dynamic": 0.1}],
    "checks": [
      {"name": "clearance", "demand": 0.37, "limit": 0.3, "utilisation": 0.8, "pass": true},
      {"name": "slack", "demand": 0.1, "limit": 0.3, "utilisation": 3, "pass": false},
      {"name": "load", "demand": 0.2, "limit": 0.3, "utilisation": 0.7, "pass": true}],
    "ropes": [{"name": "R1", "max_dynamic_tension_N": 5}]})");
  EXPECT_TRUE(is_worse_when_smaller(summary, "measures.load to ground: clearance.dynamic"));
  EXPECT_FALSE(is_worse_when_smaller(summary, "measures.load: tilt.dynamic"));
  EXPECT_TRUE(is_worse_when_smaller(summary, "checks.clearance.demand"));
  EXPECT_TRUE(is_worse_when_smaller(summary, "checks.slack.demand"));
  EXPECT_FALSE(is_worse_when_smaller(summary, "checks.clearance.utilisation"));
  EXPECT_FALSE(is_worse_when_smaller(summary, "checks.load.demand"));
  EXPECT_FALSE(is_worse_when_smaller(summary, "ropes.R1.max_dynamic_tension_N"));
  EXPECT_FALSE(is_worse_when_smaller(summary, "verdict"));
}

using Json = nlohmann::ordered_json;

Json mode(const std::string& name, double period, Json shares) {
  return {{"name", name}, {"period_s", period}, {"energy_share_by_body", std::move(shares)}};
}

Json summary_of(Json modes) {
  return {{"natural_periods", {{{"instant", "start"}, {"modes", std::move(modes)}}}}};
}

/// Periods that are compared: path below the instant's modes, s.
std::vector<std::pair<std::string, double>> periods_of(const Json& summary) {
  const std::string place = "natural_periods.start.modes.";
  std::vector<std::pair<std::string, double>> periods;
  for (const SummaryFigure& figure : list_figures(summary))
    periods.emplace_back(figure.path.substr(place.size()),
                         find_figure(summary, figure.path)->get<double>());
  return periods;
}

// Of two hooks that go equally far with the load either one may be named, by a thousandth.
TEST(SummaryFigures, PeriodsKeepTheirNamesWhereHooksSwapTheirs) {
  const Json before =
      summary_of({mode("load: yaw", 5, {{"load", 0.95}, {"C1.left", 0.025}, {"C1.right", 0.025}}),
                  mode("load and C1.right: roll about x", 1.3,
                       {{"C1.left", 0.201}, {"C1.right", 0.202}, {"load", 0.597}}),
                  mode("C1.left: pendulum along x against C1.right", 0.7,
                       {{"C1.left", 0.94}, {"C1.right", 0.05}, {"load", 0.01}}),
                  mode("load and C1.left: roll about x", 0.04,
                       {{"C1.left", 0.25}, {"C1.right", 0.24}, {"load", 0.51}})});
  const Json after =
      summary_of({mode("load: yaw", 5.1, {{"load", 0.95}, {"C1.left", 0.025}, {"C1.right", 0.025}}),
                  mode("load and C1.left: roll about x", 1.31,
                       {{"C1.left", 0.202}, {"C1.right", 0.201}, {"load", 0.597}}),
                  mode("C1.right: pendulum along x", 0.71,
                       {{"C1.left", 0.05}, {"C1.right", 0.94}, {"load", 0.01}}),
                  mode("load and C1.left: roll about x, no. 2", 0.041,
                       {{"C1.left", 0.25}, {"C1.right", 0.24}, {"load", 0.51}})});
  const std::vector<std::pair<std::string, double>> expected_before{
      {"load: yaw.period_s", 5},
      {"load: roll about x.period_s", 1.3},
      {"load: roll about x, no. 2.period_s", 0.04}};
  const std::vector<std::pair<std::string, double>> expected_after{
      {"load: yaw.period_s", 5.1},
      {"load: roll about x.period_s", 1.31},
      {"load: roll about x, no. 2.period_s", 0.041}};
  EXPECT_EQ(periods_of(before), expected_before);
  EXPECT_EQ(periods_of(after), expected_after);
  // The whole name still leads to its mode.
  const Json* whole = find_figure(before,
                                  "natural_periods.start.modes.C1.left: pendulum along x against "
                                  "C1.right.period_s");
  ASSERT_TRUE(whole);
  EXPECT_EQ(*whole, 0.7);
}

// A mode that has just too little of the load to be listed is still found for another result.
TEST(SummaryFigures, APeriodThatIsNoLongerListedIsStillFound) {
  const Json summary = summary_of({mode("load and C1.hook: roll about x", 0.04,
                                        {{"load", 0.49}, {"C1.hook", 0.26}, {"C2.hook", 0.25}})});
  EXPECT_TRUE(periods_of(summary).empty());
  EXPECT_TRUE(find_figure(summary, "natural_periods.start.modes.load: roll about x.period_s"));
}

// Two hulls of one shape: which of them leads is chance, and so is an axis' last degree.
TEST(SummaryFigures, PeriodsOfHullsThatLeadByTurnsHaveOneName) {
  const auto name_of = [](const char* name, Json shares) {
    return periods_of(summary_of({mode(name, 9, std::move(shares))})).front().first;
  };
  EXPECT_EQ(name_of("B1 and B2: surge against load", {{"B1", 0.46}, {"B2", 0.44}, {"load", 0.1}}),
            name_of("B2 and B1: surge against load", {{"B1", 0.44}, {"B2", 0.46}, {"load", 0.1}}));
  EXPECT_EQ(name_of("load: pendulum along 35 deg from x towards y", {{"load", 1.0}}),
            name_of("load: pendulum along 36 deg from x towards y", {{"load", 1.0}}));
}

}  // namespace
}  // namespace blocklift::pipeline
