#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pipeline/standards/standard_assessment.h"
#include "tests/pipeline/standards/shipped_rules.h"

namespace blocklift::pipeline::test {

inline Located<std::string> called(const std::string& name) { return {name, {}}; }

inline given::Standard by_nd_0027() {
  given::Standard standard;
  standard.rules = shipped_rules("nd-0027");
  standard.weight_class = called("B");
  standard.setting = called("onshore");
  standard.skew = called("matched");
  standard.wear = called("inspected");
  return standard;
}

/// 1,000 kN on one hook by two slings; R1 has 400 kN at rest and 460 in motion.
inline LiftFacts two_slings() {
  LiftFacts facts;
  facts.net_weight = 1000e3;
  facts.at_rest = 1000e3;
  facts.in_motion = 1040e3;
  SlingFacts sling;
  sling.name = "R1";
  sling.lug = "L1";
  sling.hook = "C1.main";
  sling.load = {400e3, 460e3, 10, 12, 1.04, 460.0 / 400 / 1.04};
  sling.breaking_load = 2000e3;
  sling.material = "steel";
  sling.termination = "resin_socket";
  sling.slings_on_hook = 2;
  facts.slings.push_back(sling);
  facts.pulls.push_back({"L1", sling.load, {{"R1", {}, 2, {0, 0, 400e3}}}});
  HookFacts hook;
  hook.name = "C1.main";
  hook.crane = "C1";
  hook.load = {1030e3, 1071.2e3, 10, 12, 1.04, 1};
  hook.hook_block = 30e3;
  hook.rigging = 20e3;
  hook.hoisting_speed = 0.2;
  hook.capacity = 1500e3;
  facts.hooks.push_back(hook);
  return facts;
}

inline const Chain& chain_of(const StandardAssessment& standard, const std::string& object) {
  const auto found = std::find_if(standard.chains.begin(), standard.chains.end(),
                                  [&](const Chain& chain) { return chain.object == object; });
  if (found == standard.chains.end()) throw std::out_of_range(object);
  return *found;
}

inline const ChainStep& step_of(const Chain& chain, const std::string& name) {
  const auto found = std::find_if(chain.steps.begin(), chain.steps.end(),
                                  [&](const ChainStep& step) { return step.name == name; });
  if (found == chain.steps.end()) throw std::out_of_range(name);
  return *found;
}

}  // namespace blocklift::pipeline::test
