#include "pipeline/standards/rigging_chains.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pipeline/standards/sling_factor.h"

namespace blocklift::pipeline {

namespace {

/// What hangs below a hook block, or the hook blocks of a crane, at rest.
void add_load_below_hook(ChainBuilder& chain, const LoadFactors& factors, const LoadFacts& load,
                         const ComputedFactors& computed, double hook_blocks, double rigging) {
  chain.add("largest load below the hook at rest", std::max(0.0, load.at_rest - hook_blocks),
            factors.facts().rest_is_from,
            fmt::format("with the hook block {}, at {:.1f} s", load_text(load.at_rest),
                        load.time_at_rest.value_or(0)));
  factors.add_contingency(chain);
  factors.add_centre(chain, computed);
  factors.add_tilt(chain, computed);
  chain.add("rigging weight", rigging, "mass of the slings' models");
}

/// What hangs on a hook or a crane, up to its dynamic load.
void add_hook_load(ChainBuilder& chain, const LoadFactors& factors, const LoadFacts& load,
                   const ComputedFactors& computed, double hook_blocks, double rigging,
                   double hoisting_speed) {
  add_load_below_hook(chain, factors, load, computed, hook_blocks, rigging);
  chain.add("hook block", hook_blocks, "crane's model");
  chain.result("static hook load");
  factors.add_amplification(chain, load.amplification, hoisting_speed);
  LoadFactors::add_resharing(chain, load);
  chain.result("dynamic hook load");
}

/// What a hook or a crane may carry, by its capacity and by its load chart, in both columns.
struct Capacity {
  double standard = 0, simulated = 0;  ///< N
  std::string text;
  bool is_by_chart = false;
};

std::optional<Capacity> capacity_of(const std::optional<double>& rated,
                                    const std::optional<ChartFacts>& chart, const LoadFacts& load,
                                    const std::string& text) {
  std::optional<Capacity> capacity;
  if (rated) capacity = Capacity{*rated, *rated, text, false};
  if (!chart || !(chart->at_rest > 0) || !(chart->in_motion > 0)) return capacity;
  const double still = ChartFacts::capacity(load.at_rest, chart->at_rest);
  const double moving = ChartFacts::capacity(load.in_motion, chart->in_motion);
  constexpr double rounding = 1 - 1e-9;  // a chart that repeats the capacity does not count
  if (!capacity || still < rounding * capacity->standard ||
      moving < rounding * capacity->simulated) {
    if (!capacity) capacity = Capacity{still, moving, {}, true};
    capacity->is_by_chart = true;
    capacity->text = fmt::format("load chart at {:.2f} m{}", chart->radius,
                                 chart->derating.empty() ? "" : ", " + chart->derating);
  }
  capacity->standard = std::min(capacity->standard, still);
  capacity->simulated = std::min(capacity->simulated, moving);
  return capacity;
}

/// The hoisting factor where the amplification is another's.
void tell_hoisting(ChainBuilder& chain, const LoadFactors& factors, double speed,
                   const LoadFacts& load) {
  const HoistingClass* hoisting = factors.hoisting_class();
  if (!hoisting || !factors.standard().setting) return;
  ChainStep step;
  step.name = "hoisting factor, for comparison";
  step.standard = hoisting->at(speed);
  step.simulated = load.at_rest > 0 ? load.in_motion / load.at_rest : 1;
  step.clause = hoisting->clause;
  step.formula = fmt::format("{}: {:g} + {:g} x {:.3f} m/s", hoisting->name.value, hoisting->least,
                             hoisting->per_speed, speed);
  chain.tell(std::move(step));
}

void tell_part(ChainBuilder& chain, const std::string& name, double standard, double simulated,
               const std::string& clause, std::string formula = {}) {
  ChainStep step;
  step.name = name;
  step.standard = standard;
  step.simulated = simulated;
  step.clause = clause;
  step.formula = std::move(formula);
  chain.tell(std::move(step));
}

/// What is left of a shackle's loads at an angle out of the plane of its bow.
struct SideLoad {
  double angle = 0;  ///< rad
  double factor = 1;
  std::string clause;
};

SideLoad side_load_at(const std::vector<SideLoadRow>& rows, double share) {
  const double angle = std::asin(std::min(1.0, share));
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const SideLoadRow& one) { return angle <= one.up_to + 1e-9; });
  if (row == rows.end()) return {angle, 0, rows.back().clause};
  return {angle, row->factor, row->clause};
}

/// Side load of the shackle at a lug, at rest and at the worst instant; none where no rule has it
/// or nothing says how the shackle's pin lies.
struct ShackleSideLoad {
  SideLoad standard, simulated;
};

std::optional<ShackleSideLoad> side_load_of(const LoadFactors& factors, const std::string& lug) {
  const auto& rows = factors.rules().shackle_side_load;
  const std::vector<LugFacts>& lugs = factors.facts().lugs;
  const auto of =
      std::find_if(lugs.begin(), lugs.end(), [&](const LugFacts& one) { return one.name == lug; });
  if (rows.empty() || of == lugs.end() || !(of->at_rest.norm() > 0)) return {};
  return ShackleSideLoad{side_load_at(rows, std::abs(of->at_rest.z()) / of->at_rest.norm()),
                         side_load_at(rows, of->lateral)};
}

void tell_side_load(ChainBuilder& chain, const LoadFactors& factors,
                    const std::optional<ShackleSideLoad>& side) {
  if (factors.rules().shackle_side_load.empty()) return;
  if (!side) {
    ChainStep step;
    step.kind = ChainStep::Kind::told;
    step.name = "side load on the shackle";
    step.clause = factors.rules().shackle_side_load.front().clause;
    step.formula = "not looked at: the lug has no padeye, whose pin would say how the shackle lies";
    chain.tell(std::move(step));
    return;
  }
  constexpr double degree = std::numbers::pi / 180;
  tell_part(chain, "side load: share of the working load", side->standard.factor,
            side->simulated.factor, side->simulated.clause,
            fmt::format("pulled {:.1f} deg out of the bow's plane at rest, {:.1f} deg at most",
                        side->standard.angle / degree, side->simulated.angle / degree));
}

/// Working load and breaking load of a master link or a sheave.
struct Accessory {
  double working_load = 0, breaking_load = 0;  ///< N
  const char* key = "";                        ///< of the case
};

void add_static_limit(ChainBuilder& chain, const LoadFactors& factors, const Accessory& accessory) {
  const auto& rules = factors.rules().accessory;
  chain.limit(accessory.working_load / (rules ? rules->working.value : 1),
              "working load " + load_text(accessory.working_load),
              rules ? rules->working.clause : accessory.key);
}

void add_dynamic_limit(ChainBuilder& chain, const LoadFactors& factors,
                       const Accessory& accessory) {
  const auto& rules = factors.rules().accessory;
  const double amplification = factors.amplification(factors.hoisting_speed());
  const double by_working =
      accessory.working_load / (rules ? rules->working.value : 1) * amplification;
  if (rules && accessory.breaking_load / rules->breaking.value < by_working) {
    chain.limit(accessory.breaking_load / rules->breaking.value,
                fmt::format("breaking load {} / {:g}", load_text(accessory.breaking_load),
                            rules->breaking.value),
                rules->breaking.clause);
    return;
  }
  chain.limit(
      by_working,
      fmt::format("working load {} x {:.3f}", load_text(accessory.working_load), amplification),
      rules ? rules->working.clause : accessory.key);
}

/// Load of a link over that of one leg by the uniform load method: EN 818-4.
std::optional<double> load_factor_by_standard(std::size_t legs, double angle) {
  if (legs < 2) return 1.0;
  if (angle <= std::numbers::pi / 4) return legs == 2 ? 1.4 : 2.1;
  if (angle <= std::numbers::pi / 3) return legs == 2 ? 1.0 : 1.5;
  return {};
}

/// How the slings at a hook share what hangs on its master link.
void tell_legs(ChainBuilder& chain, const LoadFactors& factors, const HookFacts& hook) {
  std::size_t legs = 0;
  double largest = 0, angle = 0;
  for (const SlingFacts& sling : factors.facts().slings) {
    if (!sling.is_at_hook || sling.hook != hook.name) continue;
    ++legs;
    largest = std::max(largest, sling.load.at_rest);
    angle = std::max(angle, sling.angle);
  }
  if (!(largest > 0)) return;
  ChainStep step;
  step.kind = ChainStep::Kind::told;
  step.name = "load factor of the legs";
  step.standard = load_factor_by_standard(legs, angle);
  step.simulated = std::max(0.0, hook.load.at_rest - hook.hook_block) / largest;
  step.clause = "EN 818-4";
  step.formula =
      fmt::format("{} {}, up to {:.1f} deg to the plumb; the most loaded has {} at rest", legs,
                  legs == 1 ? "leg" : "legs", angle * 180 / std::numbers::pi, load_text(largest));
  if (!step.standard) step.formula += "; no factor beyond 60 deg";
  if (legs > 2) step.formula += "; more than two go on an assembly with intermediate links";
  chain.tell(std::move(step));
}

const std::string& clause_named(const std::vector<NamedFactor>& factors, const std::string& name) {
  return find_by_name(factors, name)->clause;
}

/// Parts of a sling's safety factor, and the breaking load over it as the limit.
void add_sling_limit(ChainBuilder& chain, const LoadFactors& factors, const SlingFacts& sling) {
  const SlingRules& rules = *factors.rules().sling;
  SlingChoice choice{*sling.material, factors.standard().wear->value, *sling.termination, {}, 0};
  const std::optional<double> bend =
      sling.bend_diameter ? sling.bend_diameter : factors.standard().bend_of(sling.name);
  if (bend && sling.diameter) choice.diameter_ratio = *bend / *sling.diameter;
  const SlingFactor standard = sling_factor(rules, choice);
  if (factors.facts().has_environment && sling.load.in_motion > 0)
    choice.environment_share = std::max(0.0, 1 - sling.load.at_rest / sling.load.in_motion);
  const SlingFactor simulated = sling_factor(rules, choice);
  tell_part(chain, "safety factor: load", standard.load, simulated.load, rules.load.clause,
            rules.environment && choice.environment_share > 0
                ? fmt::format("E/T {:.3f}, {}", choice.environment_share, rules.environment->clause)
                : "");
  tell_part(chain, "safety factor: consequence", standard.consequence, simulated.consequence,
            rules.consequence.clause);
  tell_part(chain, "safety factor: material", standard.material, simulated.material,
            clause_named(rules.material, choice.material), choice.material);
  tell_part(chain, "safety factor: wear", standard.wear, simulated.wear,
            clause_named(rules.wear, choice.wear), choice.wear);
  tell_part(chain, "safety factor: reduction", standard.reduction, simulated.reduction,
            standard.bending > standard.termination
                ? rules.bending.clause
                : clause_named(rules.termination, choice.termination),
            standard.bending > standard.termination
                ? fmt::format("bent round D/d {:.2f}", *choice.diameter_ratio)
                : choice.termination);
  tell_part(chain, "safety factor by its parts", standard.by_parts, simulated.by_parts,
            rules.floor.clause);
  tell_part(chain, "safety factor by its floor", standard.by_floor, simulated.by_floor,
            rules.floor.clause,
            standard.is_by_floor() ? "it governs: a dynamic analysis gains nothing" : "");
  chain.limit(
      sling.breaking_load / standard.factor,
      fmt::format("breaking load {} / {:.3f}", load_text(sling.breaking_load), standard.factor),
      rules.floor.clause, sling.breaking_load / simulated.factor);
}

}  // namespace

Chain lift_chain(const LoadFactors& factors) {
  const LiftFacts& facts = factors.facts();
  ChainBuilder chain("lift", "as a whole");
  chain.add("net weight", facts.net_weight, "load's model");
  factors.add_contingency(chain);
  chain.result("design weight");
  chain.add("rigging weight", facts.rigging, "mass of the slings' models");
  chain.result("static hook load");
  factors.add_amplification(
      chain, facts.at_rest > 0 ? std::optional(facts.in_motion / facts.at_rest) : std::nullopt,
      factors.hoisting_speed());
  chain.result("dynamic hook load");
  return chain.finish();
}

Chain hook_chain(const LoadFactors& factors, const HookFacts& hook) {
  ChainBuilder chain("hook", hook.name);
  add_hook_load(chain, factors, hook.load, hook.computed, hook.hook_block, hook.rigging,
                hook.hoisting_speed);
  tell_hoisting(chain, factors, hook.hoisting_speed, hook.load);
  const Capacity capacity =
      *capacity_of(hook.capacity, hook.chart, hook.load, "capacity of the hoist");
  chain.limit(capacity.standard, capacity.text, "crane's model", capacity.simulated);
  return chain.finish();
}

Chain crane_chain(const LoadFactors& factors, const CraneFacts& crane) {
  ChainBuilder chain("crane", crane.name);
  add_hook_load(chain, factors, crane.load, crane.computed, crane.hook_blocks, crane.rigging,
                crane.hoisting_speed);
  const auto capacity =
      capacity_of(crane.capacity, crane.chart, crane.load, "capacity of the crane");
  if (!capacity) return chain.finish();
  const auto cranes = static_cast<int>(factors.facts().cranes.size());
  const TandemRow* row = nullptr;
  for (const TandemRow& one : factors.rules().tandem)
    if (one.cranes <= cranes && (!row || one.cranes > row->cranes)) row = &one;
  if (row)
    chain.limit(capacity->standard * row->factor,
                fmt::format("{} {} x {:g} of {} cranes",
                            capacity->is_by_chart ? capacity->text : "capacity",
                            load_text(capacity->standard), row->factor, cranes),
                row->clause, capacity->simulated * row->factor);
  else
    chain.limit(capacity->standard, capacity->text, "crane's model", capacity->simulated);
  return chain.finish();
}

Chain sling_chain(const LoadFactors& factors, const SlingFacts& sling) {
  ChainBuilder chain("sling", sling.name);
  factors.add_all(chain, sling.load, sling.computed, sling.slings_on_hook);
  chain.result("sling load");
  if (factors.rules().sling) add_sling_limit(chain, factors, sling);
  return chain.finish();
}

std::vector<Chain> shackle_chains(const LoadFactors& factors, const given::Shackle& shackle,
                                  const LugPull& pull) {
  const ShackleRules& rules = *factors.rules().shackle;
  const std::string& lug = shackle.name.value;
  const std::optional<ShackleSideLoad> side = side_load_of(factors, lug);
  const double share = side ? side->standard.factor : 1;
  const double simulated_share = side ? side->simulated.factor : 1;
  const auto derated = [&](double load) {
    return share < 1 ? fmt::format("{:g} x {}", share, load_text(load)) : load_text(load);
  };
  ChainBuilder at_rest("shackle", lug + " at rest");
  factors.add_all_at_lug(at_rest, pull, false);
  at_rest.result("static sling load");
  const double working = shackle.working_load / rules.working.value;
  tell_side_load(at_rest, factors, side);
  at_rest.limit(share * working, "working load " + derated(shackle.working_load),
                rules.working.clause, share * working);

  ChainBuilder in_motion("shackle", lug);
  factors.add_all_at_lug(in_motion, pull);
  in_motion.result("dynamic sling load");
  const double amplification = factors.amplification(factors.hoisting_speed());
  const double by_working = working * amplification;
  const double by_breaking = shackle.breaking_load / rules.breaking.value;
  tell_side_load(in_motion, factors, side);
  const double least = std::min(by_working, by_breaking);
  if (by_working < by_breaking)
    in_motion.limit(
        share * least,
        fmt::format("working load {} x {:.3f}", derated(shackle.working_load), amplification),
        rules.working.clause, simulated_share * least);
  else
    in_motion.limit(share * least,
                    fmt::format("breaking load {} / {:g}", derated(shackle.breaking_load),
                                rules.breaking.value),
                    rules.breaking.clause, simulated_share * least);
  std::vector<Chain> chains;
  chains.push_back(at_rest.finish());
  chains.push_back(in_motion.finish());
  return chains;
}

std::vector<Chain> master_link_chains(const LoadFactors& factors, const given::MasterLink& link,
                                      const HookFacts& hook) {
  const Accessory accessory{link.working_load, link.breaking_load, "standard.master_links"};
  const auto begin = [&](const std::string& name) {
    ChainBuilder chain("master link", name);
    add_load_below_hook(chain, factors, hook.load, hook.computed, hook.hook_block, hook.rigging);
    chain.result("static load of the link");
    return chain;
  };
  ChainBuilder at_rest = begin(hook.name + " at rest");
  tell_legs(at_rest, factors, hook);
  add_static_limit(at_rest, factors, accessory);

  ChainBuilder in_motion = begin(hook.name);
  factors.add_amplification(in_motion, hook.load.amplification, hook.hoisting_speed);
  LoadFactors::add_resharing(in_motion, hook.load);
  in_motion.result("dynamic load of the link");
  add_dynamic_limit(in_motion, factors, accessory);
  std::vector<Chain> chains;
  chains.push_back(at_rest.finish());
  chains.push_back(in_motion.finish());
  return chains;
}

std::vector<Chain> sheave_chains(const LoadFactors& factors, const given::Sheave& sheave,
                                 const SlingFacts& sling) {
  const Accessory accessory{sheave.working_load, sheave.breaking_load, "standard.sheaves"};
  const auto begin = [&](const std::string& name, bool in_motion) {
    ChainBuilder chain("sheave", name);
    factors.add_all(chain, sling.load, sling.computed, sling.slings_on_hook, in_motion);
    chain.times("both parts of the sling", 2, 2, "parallel parts",
                "twice its load on the pin; less where the parts are not parallel");
    chain.result(in_motion ? "dynamic load of the pin" : "static load of the pin");
    return chain;
  };
  ChainBuilder at_rest = begin(sling.name + " at rest", false);
  add_static_limit(at_rest, factors, accessory);
  ChainBuilder in_motion = begin(sling.name, true);
  add_dynamic_limit(in_motion, factors, accessory);
  std::vector<Chain> chains;
  chains.push_back(at_rest.finish());
  chains.push_back(in_motion.finish());
  return chains;
}

Chain spreader_chain(const LoadFactors& factors, const SpreaderFacts& spreader) {
  ChainBuilder chain("spreader", spreader.name);
  factors.add_all_but_skew(chain, spreader.load, spreader.computed, spreader.slings_on_hook);
  factors.add_frame_skew(chain, spreader);
  chain.result(spreader.is_frame ? "load below the frame" : "load below the bar");
  factors.add_lift_point_consequence(chain);
  if (!(spreader.borne_at_rest > 0) || !(spreader.borne_in_motion > 0)) return chain.finish();
  const double factor = factors.facts().spreader_factor;
  chain.limit(
      spreader.borne_at_rest / factor,
      fmt::format("resistance {} {} / {:g}", spreader.is_frame ? "of its sides" : "as a column",
                  load_text(spreader.borne_at_rest), factor),
      "EN 1993-1-1, 6.3.1", spreader.borne_in_motion / factor);
  return chain.finish();
}

}  // namespace blocklift::pipeline
