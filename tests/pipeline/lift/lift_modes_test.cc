// What is said of motions that nothing brings back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/lift/natural_modes.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

NaturalModes growing(const std::string& name, bool heading_is_held) {
  NaturalModes modes{"start", {}, heading_is_held};
  dynamics::Mode mode;
  mode.kind = dynamics::ModeKind::unstable;
  mode.eigenvalue = 0.1;
  mode.name = name;
  modes.linearisation.modes.push_back(mode);
  return modes;
}

// The turn of a load whose heading is held at rest is the wind's; another that grows is unstable.
TEST(LiftModesTest, SayWhatTheWindTurns) {
  const NaturalModes turned = growing("load: yaw", true);
  EXPECT_EQ(describe_natural_periods(turned),
            "natural periods at the start: load: yaw (turned by the wind, nothing holds it)");
  for (const NaturalModes& other : {growing("load: yaw", false), growing("load: roll", true)})
    EXPECT_THAT(describe_natural_periods(other), HasSubstr("(unstable)"));
  const dynamics::Mechanism mechanism = dynamics::MechanismBuilder().build();
  const auto json = natural_periods_json(mechanism, {turned, growing("load: yaw", false)});
  EXPECT_TRUE(json[0]["modes"][0]["turned_by_wind"].get<bool>());
  EXPECT_FALSE(json[1]["modes"][0].contains("turned_by_wind"));
}

}  // namespace
}  // namespace blocklift::pipeline
