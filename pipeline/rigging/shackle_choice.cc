#include "pipeline/rigging/shackle_choice.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pipeline/checks/standard_checks.h"
#include "pipeline/lift/sling_ends.h"
#include "pipeline/rigging/sling_choice.h"
#include "pipeline/standards/rigging_chains.h"

namespace blocklift::pipeline {
namespace {

std::vector<Check> check_shackle(const ShackleInStock& candidate, const LiftCase& lift_case,
                                 const std::optional<LiftFacts>& facts,
                                 const ShackleDemand& demand) {
  const StockShackle& shackle = candidate.shackle;
  if (!facts || !lift_case.standard->rules.shackle)
    return {check_working_load(shackle.working_load, candidate.rule, demand.at_rest, demand.hook)};
  const LoadFactors factors(*lift_case.standard, *facts);
  const auto pull = std::find_if(facts->pulls.begin(), facts->pulls.end(),
                                 [&](const LugPull& one) { return one.lug == demand.lug; });
  StandardAssessment assessment;
  assessment.name = lift_case.standard->rules.name;
  assessment.chains = shackle_chains(
      factors, {{demand.lug, {}}, shackle.working_load, shackle.breaking_load}, *pull);
  std::vector<Check> checks = checks_of(assessment);
  for (std::size_t i = 0; i < checks.size(); ++i)
    checks[i].name = fmt::format("{}, {}", assessment.name, i == 0 ? "at rest" : "in motion");
  return checks;
}

}  // namespace

ChosenShackle choose_shackle(const Stock& stock, const LiftCase& lift_case,
                             const std::optional<LiftFacts>& facts, const ShackleDemand& demand) {
  ChosenShackle chosen;
  chosen.lug = demand.lug;
  for (std::size_t i = 0; i < stock.shackles.size() && !chosen.pass(); ++i) {
    chosen.index = i;
    chosen.checks = check_shackle(stock.shackles[i], lift_case, facts, demand);
  }
  return chosen;
}

std::vector<ShackleDemand> shackle_demands(const LiftCase& lift_case, const LiftRun& lift) {
  std::vector<ShackleDemand> demands;
  for (const LugEnds& lug : find_lug_ends(lift.model)) {
    ShackleDemand demand{lug.lug, lug.load(lift.static_history).maxCoeff(), {}};
    bool has_sling = false;
    for (const SlingEnd& end : lug.ends) {
      const given::Rope& rope = *lift_case.find_rope(lift.model.ropes[end.sling].name);
      if (!rope.is_sling() || rope.winch) continue;
      has_sling = true;
      const SharedHook hook = find_shared_hook(lift_case, lift, rope.name.value);
      if (hook.load / hook.leg_factor() > demand.hook.load / demand.hook.leg_factor())
        demand.hook = hook;
    }
    if (has_sling) demands.push_back(std::move(demand));
  }
  return demands;
}

}  // namespace blocklift::pipeline
