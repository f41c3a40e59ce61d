#include "pipeline/standards/standard_assessment.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pipeline/standards/load_factors.h"
#include "pipeline/standards/rigging_chains.h"
#include "pipeline/standards/structure_chains.h"

namespace blocklift::pipeline {

namespace {

const ChainStep* find_step(const Chain& chain, const std::string& name) {
  const auto found = std::find_if(chain.steps.begin(), chain.steps.end(),
                                  [&](const ChainStep& step) { return step.name == name; });
  return found == chain.steps.end() ? nullptr : &*found;
}

/// Product of the factors of a chain that stand for motion: amplification, tilt and yaw.
double cover_of(const Chain& chain) {
  double product = 1;
  for (const char* name : {"dynamic amplification", "tilt", "yaw"})
    if (const ChainStep* step = find_step(chain, name)) product *= step->standard.value_or(1);
  return product;
}

/// What motion does to slings, beside what the rules hold ready for it.
void tell_motion(const LiftFacts& facts, const std::vector<Chain>& chains, double amplification,
                 std::vector<std::string>& notes) {
  double least = 1e9, most = 0;
  std::string most_name, uncovered, covered_by_skew;
  std::optional<double> most_share;
  for (const SlingFacts& sling : facts.slings) {
    if (!(sling.load.at_rest > 0)) continue;
    const double ratio = sling.load.in_motion / sling.load.at_rest;
    least = std::min(least, ratio);
    if (ratio > most) {
      most = ratio;
      most_name = sling.name;
      most_share = sling.load.share_of_resharing();
    }
    const auto chain = std::find_if(chains.begin(), chains.end(), [&](const Chain& one) {
      return one.kind == "sling" && one.name == sling.name;
    });
    const double cover = cover_of(*chain);
    const ChainStep* skew = find_step(*chain, "skew of sling lengths");
    const double with_skew = cover * (skew ? skew->standard.value_or(1) : 1);
    if (ratio > with_skew)
      uncovered += fmt::format("{}{} {:.3f} > {:.3f}", uncovered.empty() ? "" : ", ", sling.name,
                               ratio, with_skew);
    else if (ratio > cover)
      covered_by_skew += fmt::format("{}{} {:.3f} > {:.3f}", covered_by_skew.empty() ? "" : ", ",
                                     sling.name, ratio, cover);
  }
  if (most <= 0) return;
  std::string note = fmt::format(
      "Motion multiplies the largest loads of the slings by {:.3f} to {:.3f}, and that of all "
      "hooks "
      "together by {:.3f}; the rules' dynamic amplification of {:.3f} holds for the hook.",
      least, most, facts.at_rest > 0 ? facts.in_motion / facts.at_rest : 1, amplification);
  if (most_share && *most_share >= 0)
    note += fmt::format(" In {} {:.0f} % of the increase is re-sharing between the slings.",
                        most_name, 100 * std::min(1.0, *most_share));
  notes.push_back(std::move(note));
  if (!uncovered.empty())
    notes.push_back(
        "Motion multiplies these loads by more than all factors of the rules for motion and "
        "sharing together: " +
        uncovered + ".");
  if (!covered_by_skew.empty())
    notes.push_back(
        "Amplification, tilt and yaw of the rules do not cover the motion of these slings; only "
        "their skew factor, which stands for sling lengths, does: " +
        covered_by_skew + ".");
}

/// Slings for which a dynamic analysis cannot lower the safety factor.
void tell_floor(const std::vector<Chain>& chains, std::vector<std::string>& notes) {
  std::string names;
  for (const Chain& chain : chains) {
    const ChainStep* parts = find_step(chain, "safety factor by its parts");
    const ChainStep* floor = find_step(chain, "safety factor by its floor");
    if (!parts || !floor || *parts->standard > *floor->standard) continue;
    names += (names.empty() ? "" : ", ") + chain.name;
  }
  if (names.empty()) return;
  notes.push_back("The safety factor of " + names +
                  " is the floor of the rules: a dynamic analysis cannot lower it.");
}

/// Hooks that share the load by different heights, of which the case takes no account.
void tell_tilt(const LoadFactors& factors, std::vector<std::string>& notes) {
  if (factors.standard().tilt || factors.rules().tilt.empty()) return;
  const auto share = [](const HookFacts& hook) { return hook.computed.two_hooks.has_value(); };
  const std::vector<HookFacts>& hooks = factors.facts().hooks;
  if (std::none_of(hooks.begin(), hooks.end(), share)) return;
  notes.push_back(fmt::format(
      "The load hangs on two hooks and the case names no tilt: that the hooks may differ in height "
      "({}) and yaw are in no chain.",
      factors.rules().tilt.front().clause));
}

void tell_gaps(const LoadFactors& factors, std::vector<std::string>& notes) {
  const LiftFacts& facts = factors.facts();
  if (!facts.slings.empty() && !facts.has_rigging_weight)
    notes.push_back("Not every sling's model gives its mass: the rigging weight is too small.");
  if (factors.rules().lug.empty()) return;
  for (const LugFacts& lug : facts.lugs)
    for (const NamedFactor& family : factors.rules().lug)
      if (family.name.value == "asme_bth_1" && !lug.input.tensile_strength) {
        notes.push_back(
            "Formulae of ASME BTH-1 are left out where a padeye's model gives no "
            "tensile strength.");
        return;
      }
}

}  // namespace

const Chain* StandardAssessment::governing() const {
  const Chain* worst = nullptr;
  for (const Chain& chain : chains)
    if (chain.has_limit() && (!worst || chain.utilisation() > worst->utilisation())) worst = &chain;
  return worst;
}

StandardAssessment assess_standard(const given::Standard& standard, const LiftFacts& facts) {
  const LoadFactors factors(standard, facts);
  const StandardRules& rules = standard.rules;
  StandardAssessment result{rules.name, rules.title, rules.edition, rules.source, {}, {}};
  std::vector<Chain>& chains = result.chains;
  chains.push_back(lift_chain(factors));
  for (const HookFacts& hook : facts.hooks) chains.push_back(hook_chain(factors, hook));
  for (const SlingFacts& sling : facts.slings) chains.push_back(sling_chain(factors, sling));
  for (const given::Shackle& shackle : standard.shackles)
    for (const LugPull& pull : facts.pulls)
      if (pull.lug == shackle.name.value)
        for (Chain& chain : shackle_chains(factors, shackle, pull))
          chains.push_back(std::move(chain));
  for (const given::MasterLink& link : standard.master_links)
    for (const HookFacts& hook : facts.hooks)
      if (hook.name == link.name.value)
        for (Chain& chain : master_link_chains(factors, link, hook))
          chains.push_back(std::move(chain));
  for (const given::Sheave& sheave : standard.sheaves)
    for (const SlingFacts& sling : facts.slings)
      if (sling.name == sheave.name.value)
        for (Chain& chain : sheave_chains(factors, sheave, sling))
          chains.push_back(std::move(chain));
  for (const SpreaderFacts& spreader : facts.spreaders)
    chains.push_back(spreader_chain(factors, spreader));
  for (const LugFacts& lug : facts.lugs) chains.push_back(lug_chain(factors, lug));
  for (const CraneFacts& crane : facts.cranes) chains.push_back(crane_chain(factors, crane));
  for (const StressFacts& stress : facts.stresses) chains.push_back(stress_chain(factors, stress));
  tell_motion(facts, chains, factors.amplification(factors.hoisting_speed()), result.notes);
  tell_floor(chains, result.notes);
  tell_tilt(factors, result.notes);
  tell_gaps(factors, result.notes);
  return result;
}

}  // namespace blocklift::pipeline
