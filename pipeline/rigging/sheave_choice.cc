#include "pipeline/rigging/sheave_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "pipeline/checks/standard_checks.h"
#include "pipeline/standards/rigging_chains.h"

namespace blocklift::pipeline {
namespace {

std::vector<Check> check_sheave_of(const SheaveInStock& candidate, const LiftCase& lift_case,
                                   const std::optional<LiftFacts>& facts,
                                   const SlingDemand& demand) {
  const StockSheave& sheave = candidate.sheave;
  if (!facts)
    return {check_at_most(fmt::format("working load at rest, {}", candidate.rule),
                          2 * demand.at_rest, sheave.working_load, "N")};
  const LoadFactors factors(*lift_case.standard, *facts);
  const auto sling = std::find_if(facts->slings.begin(), facts->slings.end(),
                                  [&](const SlingFacts& one) { return one.name == demand.rope; });
  StandardAssessment assessment;
  assessment.name = lift_case.standard->rules.name;
  assessment.chains = sheave_chains(
      factors, {{demand.rope, {}}, sheave.working_load, sheave.breaking_load, sheave.tread},
      *sling);
  std::vector<Check> checks = checks_of(assessment);
  for (std::size_t i = 0; i < checks.size(); ++i)
    checks[i].name = fmt::format("{}, {}", assessment.name, i == 0 ? "at rest" : "in motion");
  return checks;
}

}  // namespace

bool is_led_over_sheaves(const given::Rope& rope) { return rope.path.size() > 2; }

ChosenSheave choose_sheave(const Stock& stock, const LiftCase& lift_case,
                           const std::optional<LiftFacts>& facts, const SlingDemand& demand,
                           const RopeModel& sling) {
  ChosenSheave chosen{demand.rope, {}, {}};
  for (std::size_t i = 0; i < stock.sheaves.size() && !chosen.pass(); ++i) {
    if (!sling.diameter || *sling.diameter > stock.sheaves[i].sheave.rope * (1 + 1e-9)) continue;
    chosen.index = i;
    chosen.checks = check_sheave_of(stock.sheaves[i], lift_case, facts, demand);
  }
  return chosen;
}

}  // namespace blocklift::pipeline
