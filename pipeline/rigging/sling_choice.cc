#include "pipeline/rigging/sling_choice.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "dynamics/simulation/history.h"
#include "pipeline/checks/standard_checks.h"
#include "pipeline/standards/rigging_chains.h"
#include "pipeline/standards/sling_factor.h"

namespace blocklift::pipeline {
namespace {

/// The facts with one sling's rope replaced.
SlingFacts with_rope(const LiftFacts& facts, const std::string& rope, const RopeModel& model) {
  const auto found = std::find_if(facts.slings.begin(), facts.slings.end(),
                                  [&](const SlingFacts& sling) { return sling.name == rope; });
  SlingFacts sling = *found;
  sling.breaking_load = model.breaking_load;
  if (model.material) sling.material = model.material->value;
  if (model.termination) sling.termination = model.termination->value;
  sling.diameter = model.diameter;
  return sling;
}

std::string obstacle_of_name(const char* key, const std::optional<Located<std::string>>& name,
                             const std::vector<NamedFactor>& known, const std::string& rules) {
  if (!name) return fmt::format("it has no {}, which {} needs for slings", key, rules);
  if (find_by_name(known, name->value)) return {};
  return fmt::format("{} has no {} \"{}\"", rules, key, name->value);
}

}  // namespace

std::optional<double> SlingChecks::bend_diameter(const std::string& name) const {
  const given::Rope* rope = case_.find_rope(name);
  const std::optional<double> own = rope ? rope->least_bend() : std::nullopt;
  if (rope && rope->bend_diameter) return own;
  const std::optional<double> by_standard =
      case_.standard ? case_.standard->bend_of(name) : std::nullopt;
  if (own && by_standard) return std::min(*own, *by_standard);
  return own ? own : by_standard;
}

std::string SlingChecks::obstacle(const SlingInStock& candidate, const SlingDemand& demand) const {
  const RopeModel& rope = candidate.sling.rope;
  if (case_.standard && case_.standard->rules.sling) {
    const given::Standard& standard = *case_.standard;
    const SlingRules& rules = *standard.rules.sling;
    std::string obstacle =
        obstacle_of_name("material", rope.material, rules.material, standard.rules.name);
    if (obstacle.empty())
      obstacle =
          obstacle_of_name("termination", rope.termination, rules.termination, standard.rules.name);
    if (!obstacle.empty()) return obstacle;
  }
  const std::optional<double> bend = bend_diameter(demand.rope);
  if (!bend) return {};
  if (!rope.diameter) return "it has no diameter, which the bend diameter is held against";
  if (*bend < *rope.diameter) return "it is bent round less than its own diameter";
  return {};
}

std::vector<Check> SlingChecks::of(const SlingInStock& candidate, const SlingDemand& demand) const {
  const double factor = case_.checks.rope_safety_factor;
  const RopeModel& rope = candidate.sling.rope;
  const given::Rope* in_case = case_.find_rope(demand.rope);
  const std::optional<double> bend = in_case ? in_case->least_bend() : std::nullopt;
  const double left = bend ? bend_efficiency(*bend, *rope.diameter) : 1;
  std::vector<Check> checks;
  checks.push_back(check_at_most(fmt::format("breaking load / {:g}", factor),
                                 std::max(demand.at_rest, demand.in_motion),
                                 left * rope.breaking_load / factor, "N"));
  if (!has_rules()) {
    checks.push_back(check_working_load(candidate.sling.working_load, candidate.rule,
                                        demand.at_rest, demand.hook));
    if (demand.hook.legs > 1 && counts_legs(candidate.rule))
      checks.push_back(check_at_most(fmt::format("angle of the legs, {}", candidate.rule),
                                     demand.hook.angle, largest_leg_angle(), "rad"));
    return checks;
  }
  const LoadFactors factors(*case_.standard, *facts_);
  StandardAssessment assessment;
  assessment.name = case_.standard->rules.name;
  assessment.chains.push_back(sling_chain(factors, with_rope(*facts_, demand.rope, rope)));
  const Chain& chain = assessment.chains.front();
  for (Check& check : checks_of(assessment)) {
    check.name = fmt::format(
        "{}, breaking load / {:.3g}, by {}", assessment.name, rope.breaking_load / check.limit,
        chain.simulated_utilisation() > chain.standard_utilisation() ? "the simulation"
                                                                     : "its factors");
    checks.push_back(std::move(check));
  }
  return checks;
}

Check check_working_load(double working_load, const std::string& rule, double at_rest,
                         const SharedHook& hook) {
  const std::string legs = legs_note(at_rest, hook, rule);
  return check_at_most(
      fmt::format("working load at rest, {}{}", rule, legs.empty() ? legs : ", " + legs),
      demand_with_legs(at_rest, hook, rule), working_load, "N");
}

ChosenSling choose_sling(const Stock& stock, const SlingChecks& checks, const SlingDemand& demand) {
  std::optional<ChosenSling> nearest;
  double least_use = 0;
  std::string obstacle;
  for (std::size_t i = 0; i < stock.slings.size(); ++i) {
    const SlingInStock& candidate = stock.slings[i];
    if (const std::string reason = checks.obstacle(candidate, demand); !reason.empty()) {
      obstacle = fmt::format("{}: {}", candidate.name(), reason);
      continue;
    }
    ChosenSling chosen{i, checks.of(candidate, demand)};
    if (chosen.pass()) return chosen;
    const double use = governing_check(chosen.checks)->utilisation;
    if (nearest && !(use < least_use)) continue;
    nearest = std::move(chosen);
    least_use = use;
  }
  if (nearest) return *nearest;
  Diagnostics diagnostics;
  diagnostics.error(
      {std::make_shared<const std::string>("stock"), 0, 0},
      fmt::format("no sling of the stock can be held against the checks of {}", demand.rope),
      {obstacle});
  throw InputError(diagnostics);
}

std::vector<SlingDemand> sling_demands(const LiftCase& lift_case, const LiftRun& lift) {
  const auto at_rest = dynamics::find_largest_tensions(lift.static_history);
  const auto in_motion = dynamics::find_largest_tensions(lift.dynamic_history());
  std::vector<SlingDemand> demands;
  for (const LiftRope& rope : lift.model.ropes) {
    const given::Rope& in_case = *lift_case.find_rope(rope.name);
    if (!in_case.is_sling() || in_case.winch) continue;
    const auto i = static_cast<std::size_t>(rope.rope);
    demands.push_back({rope.name, rope.lug, at_rest[i].tension, in_motion[i].tension,
                       find_shared_hook(lift_case, lift, rope.name)});
  }
  return demands;
}

}  // namespace blocklift::pipeline
