#include "pipeline/comparison/summary_figures.h"

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

}  // namespace
}  // namespace blocklift::pipeline
