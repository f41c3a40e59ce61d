#include "pipeline/rigging/shackle_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "pipeline/checks/standard_checks.h"
#include "pipeline/standards/rigging_chains.h"

namespace blocklift::pipeline {
namespace {

std::vector<Check> check_shackle(const ShackleInStock& candidate, const LiftCase& lift_case,
                                 const std::optional<LiftFacts>& facts, const SlingDemand& demand) {
  const StockShackle& shackle = candidate.shackle;
  if (!facts || !lift_case.standard->rules.shackle)
    return {check_working_load(shackle.working_load, candidate.rule, demand)};
  const LoadFactors factors(*lift_case.standard, *facts);
  const auto sling = std::find_if(facts->slings.begin(), facts->slings.end(),
                                  [&](const SlingFacts& one) { return one.name == demand.rope; });
  StandardAssessment assessment;
  assessment.name = lift_case.standard->rules.name;
  assessment.chains = shackle_chains(
      factors, {{demand.lug, {}}, shackle.working_load, shackle.breaking_load}, *sling);
  std::vector<Check> checks = checks_of(assessment);
  for (std::size_t i = 0; i < checks.size(); ++i)
    checks[i].name = fmt::format("{}, {}", assessment.name, i == 0 ? "at rest" : "in motion");
  return checks;
}

}  // namespace

ChosenShackle choose_shackle(const Stock& stock, const LiftCase& lift_case,
                             const std::optional<LiftFacts>& facts, const SlingDemand& demand) {
  ChosenShackle chosen;
  chosen.lug = demand.lug;
  for (std::size_t i = 0; i < stock.shackles.size() && !chosen.pass(); ++i) {
    chosen.index = i;
    chosen.checks = check_shackle(stock.shackles[i], lift_case, facts, demand);
  }
  return chosen;
}

}  // namespace blocklift::pipeline
