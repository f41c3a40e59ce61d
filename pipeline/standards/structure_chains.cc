#include "pipeline/standards/structure_chains.h"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

using structure::PadeyeFormula;
using structure::PadeyeFormulaInput;
using structure::Vector3;

/// Formulae of a family with its factor: a design factor of ASME BTH-1, on the load elsewhere but
/// for what EN 1993-1-8 asks in service.
std::vector<PadeyeFormula> formulae_of(const NamedFactor& family, PadeyeFormulaInput input,
                                       const Vector3& force_P) {
  using Formulae =
      std::function<std::vector<PadeyeFormula>(const PadeyeFormulaInput&, const Vector3&)>;
  static const std::map<std::string, Formulae> families{
      {"working_stress", structure::padeye_working_stress},
      {"dnv_2_7_3", structure::padeye_dnv_2_7_3},
      {"en_1993_1_8", structure::padeye_en_1993_1_8}};
  if (family.name.value == "asme_bth_1") {
    input.design_factor = family.value;
    return structure::padeye_asme_bth_1(input, force_P);
  }
  std::vector<PadeyeFormula> formulae =
      families.at(family.name.value)(input, family.value * force_P);
  if (family.name.value == "en_1993_1_8") {  // a shackle's pin is replaceable
    const auto in_service = structure::padeye_en_1993_1_8_replaceable(input, force_P);
    formulae.insert(formulae.end(), in_service.begin(), in_service.end());
  }
  return formulae;
}

/// The formula of the largest utilisation.
struct WorstFormula {
  double utilisation = 0;
  std::string text, clause;
};

WorstFormula worst_formula(const StandardRules& rules, const PadeyeFormulaInput& input,
                           const Vector3& force_P) {
  WorstFormula worst;
  for (const NamedFactor& family : rules.lug)
    for (const PadeyeFormula& formula : formulae_of(family, input, force_P)) {
      if (formula.utilisation <= worst.utilisation) continue;
      worst = {formula.utilisation, formula.name, family.clause};
    }
  return worst;
}

/// A force of that size along a direction; plumb up where there is none.
Vector3 along(const Vector3& direction, double size) {
  const double norm = direction.norm();
  return norm > 0 ? Vector3(size / norm * direction) : Vector3(0, size, 0);
}

}  // namespace

Chain lug_chain(const LoadFactors& factors, const LugFacts& lug) {
  const StandardRules& rules = factors.rules();
  ChainBuilder chain("lug", lug.name);
  factors.add_all_at_lug(chain, lug.pull);
  chain.result("lift point load");
  factors.add_lift_point_consequence(chain);
  PadeyeFormulaInput input = lug.input;
  input.side_load = rules.lateral ? rules.lateral->value : factors.facts().lateral;
  ChainStep lateral;
  lateral.name = "lateral load over the load";
  lateral.standard = input.side_load;
  lateral.simulated = lug.lateral;
  lateral.clause = rules.lateral ? rules.lateral->clause : "checks.lug_side_load";
  lateral.formula = "along the pin, where it is largest";
  if (lug.lateral_time) lateral.formula += fmt::format(", at {:.1f} s", *lug.lateral_time);
  chain.tell(std::move(lateral));
  const double standard = chain.standard(), simulated = chain.simulated();
  const WorstFormula by_rules = worst_formula(rules, input, along(lug.at_rest, standard));
  input.side_load = std::max(input.side_load, lug.lateral);
  const WorstFormula as_simulated = worst_formula(rules, input, along(lug.in_motion, simulated));
  if (by_rules.utilisation > 0 && as_simulated.utilisation > 0) {
    const WorstFormula& worse =
        as_simulated.utilisation > by_rules.utilisation ? as_simulated : by_rules;
    chain.limit(standard / by_rules.utilisation, worse.text, worse.clause,
                simulated / as_simulated.utilisation);
  }
  return chain.finish();
}

Chain stress_chain(const LoadFactors& factors, const StressFacts& stress) {
  ChainBuilder chain("structure", stress.name, "Pa");
  chain.add("largest checked stress at rest", stress.at_rest, factors.facts().rest_is_from);
  factors.add_contingency(chain);
  factors.add_structure_centre(chain, stress);
  factors.add_amplification(
      chain, stress.at_rest > 0 ? std::optional(stress.in_motion / stress.at_rest) : std::nullopt,
      factors.hoisting_speed());
  factors.add_structure_tilt(chain, stress);
  factors.add_structure_skew(chain, stress);
  if (const auto& consequence = factors.rules().consequence) {
    const auto& factor = stress.is_at_lug ? consequence->members : consequence->others;
    if (factor) chain.times("consequence", factor->value, factor->value, factor->clause);
  }
  chain.result("stress");
  const double allowed = stress.yield / factors.facts().yield_factor;
  const std::string yield =
      fmt::format("yield {:.0f} MPa / {:g}", stress.yield / 1e6, factors.facts().yield_factor);
  const auto& fine = factors.rules().fine_mesh;
  const ClauseFactor* local = fine && stress.site ? fine->of(*stress.site) : nullptr;
  if (local)
    chain.limit(local->value * allowed, fmt::format("{:g} x {}", local->value, yield),
                local->clause);
  else
    chain.limit(allowed, yield, "checks.yield_factor");
  return chain.finish();
}

}  // namespace blocklift::pipeline
