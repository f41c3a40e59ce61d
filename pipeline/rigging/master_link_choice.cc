#include "pipeline/rigging/master_link_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "pipeline/checks/standard_checks.h"
#include "pipeline/standards/rigging_chains.h"

namespace blocklift::pipeline {
namespace {

const HookFacts* find_hook(const std::optional<LiftFacts>& facts, const std::string& name) {
  if (!facts) return nullptr;
  const auto hook = std::find_if(facts->hooks.begin(), facts->hooks.end(),
                                 [&](const HookFacts& one) { return one.name == name; });
  return hook == facts->hooks.end() ? nullptr : &*hook;
}

std::vector<Check> check_link(const MasterLinkInStock& candidate, const LiftCase& lift_case,
                              const std::optional<LiftFacts>& facts,
                              const MasterLinkDemand& demand) {
  const StockMasterLink& link = candidate.link;
  const HookFacts* hook = find_hook(facts, demand.hook);
  if (!hook)
    return {check_at_most(fmt::format("working load at rest, {}", candidate.rule), demand.at_rest,
                          link.working_load, "N")};
  const LoadFactors factors(*lift_case.standard, *facts);
  // The weight of a link that the case has already is in the facts.
  HookFacts with_link = *hook;
  const given::MasterLink* known = find_by_name(lift_case.standard->master_links, demand.hook);
  with_link.rigging += (link.mass - (known ? known->mass : 0)) * lift_case.gravity;
  StandardAssessment assessment;
  assessment.name = lift_case.standard->rules.name;
  assessment.chains = master_link_chains(
      factors, {{demand.hook, {}}, link.working_load, link.breaking_load, link.mass}, with_link);
  std::vector<Check> checks = checks_of(assessment);
  for (std::size_t i = 0; i < checks.size(); ++i)
    checks[i].name = fmt::format("{}, {}", assessment.name, i == 0 ? "at rest" : "in motion");
  return checks;
}

}  // namespace

std::vector<MasterLinkDemand> master_link_demands(const LiftCase& lift_case, const LiftRun& lift) {
  std::vector<MasterLinkDemand> demands;
  for (const LiftHoist& hoist : lift.model.hoists) {
    MasterLinkDemand demand{hoist.name, 0, 0};
    for (const given::Rope& rope : lift_case.ropes)
      if (rope.is_sling() && rope.path.front().kind == ResolvedPoint::Kind::hook &&
          rope.path.front().body_name(lift_case.cranes) == hoist.name)
        ++demand.legs;
    if (demand.legs < 2) continue;
    const given::Crane& crane = lift_case.cranes[hoist.crane];
    const HoistModel& model = *crane.model->find_hoist(hoist.name.substr(hoist.name.find('.') + 1));
    const auto& tackle = lift.static_history.ropes[hoist.rope];
    demand.at_rest =
        std::max(0.0, tackle.tension.maxCoeff() - model.hook_block.mass * lift_case.gravity);
    demands.push_back(demand);
  }
  return demands;
}

std::optional<ChosenMasterLink> choose_master_link(const Stock& stock, const LiftCase& lift_case,
                                                   const std::optional<LiftFacts>& facts,
                                                   const MasterLinkDemand& demand) {
  std::optional<ChosenMasterLink> chosen;
  for (std::size_t i = 0; i < stock.master_links.size() && !(chosen && chosen->pass()); ++i)
    chosen =
        ChosenMasterLink{demand, i, check_link(stock.master_links[i], lift_case, facts, demand)};
  return chosen;
}

}  // namespace blocklift::pipeline
