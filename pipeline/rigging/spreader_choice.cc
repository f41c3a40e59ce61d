#include "pipeline/rigging/spreader_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "pipeline/checks/frame_skew.h"
#include "pipeline/checks/standard_checks.h"
#include "pipeline/measures/spreader_measures.h"
#include "pipeline/standards/rigging_chains.h"

namespace blocklift::pipeline {
namespace {

constexpr double same_length = 1e-3;  // m

bool is_as_large(const SpreaderInStock& one, const given::Spreader& in_case) {
  const given::Spreader& bar = one.spreader.bar;
  return bar.is_frame() == in_case.is_frame() &&
         std::abs(bar.length.value - in_case.length.value) <= same_length &&
         (!bar.is_frame() || std::abs(*bar.width - *in_case.width) <= same_length);
}

const LiftSpreader& bar_of(const LiftRun& lift, const std::string& name) {
  return *std::find_if(lift.model.spreaders.begin(), lift.model.spreaders.end(),
                       [&](const LiftSpreader& one) { return one.name == name; });
}

/// By the chain of the rules, with the candidate's resistance in place of that of the case's bar.
std::vector<Check> checks_by_rules(const given::Spreader& candidate, const LiftCase& lift_case,
                                   const LiftRun& lift, const LiftFacts& facts,
                                   const LiftSpreader& bar) {
  SpreaderFacts spreader =
      *std::find_if(facts.spreaders.begin(), facts.spreaders.end(),
                    [&](const SpreaderFacts& one) { return one.name == bar.name; });
  spreader.borne_at_rest = borne_load(candidate, bar, lift.static_history);
  spreader.borne_in_motion = borne_load(candidate, bar, lift.dynamic_history());
  find_frame_skew(candidate, bar, lift_case, lift, spreader);
  StandardAssessment assessment;
  assessment.name = lift_case.standard->rules.name;
  assessment.chains.push_back(spreader_chain(LoadFactors(*lift_case.standard, facts), spreader));
  return checks_of(assessment);
}

}  // namespace

bool has_spreaders_of_size(const Stock& stock, const given::Spreader& in_case) {
  return std::any_of(stock.spreaders.begin(), stock.spreaders.end(),
                     [&](const SpreaderInStock& one) { return is_as_large(one, in_case); });
}

std::vector<Check> check_spreader(const SpreaderInStock& candidate, const LiftCase& lift_case,
                                  const LiftRun& lift, const std::optional<LiftFacts>& facts,
                                  const std::string& name) {
  const LiftSpreader& bar = bar_of(lift, name);
  const double factor = spreader_factor(lift_case.checks);
  std::vector<Check> checks{
      check_at_most(fmt::format("resistance of the {} / {:g}",
                                candidate.spreader.bar.is_frame() ? "frame" : "bar", factor),
                    largest_share(candidate.spreader.bar, bar, lift, factor), 1, "1"),
      check_at_most(fmt::format("working load at rest, {}", candidate.rule),
                    std::max(0.0, hung_load(bar, lift.static_history).maxCoeff()),
                    candidate.spreader.working_load, "N")};
  if (facts)
    for (Check& check : checks_by_rules(candidate.spreader.bar, lift_case, lift, *facts, bar))
      checks.push_back(std::move(check));
  return checks;
}

ChosenSpreader choose_spreader(const Stock& stock, const LiftCase& lift_case, const LiftRun& lift,
                               const std::optional<LiftFacts>& facts, const std::string& name) {
  const given::Spreader& in_case = *lift_case.find_spreader(name);
  std::optional<ChosenSpreader> lightest, nearest;
  double least_use = 0;
  for (std::size_t i = 0; i < stock.spreaders.size(); ++i) {
    const SpreaderInStock& candidate = stock.spreaders[i];
    if (!is_as_large(candidate, in_case)) continue;
    ChosenSpreader chosen{name, i, check_spreader(candidate, lift_case, lift, facts, name)};
    const double use = governing_check(chosen.checks)->utilisation;
    const bool is_lighter = !lightest || candidate.spreader.bar.mass() <
                                             stock.spreaders[lightest->index].spreader.bar.mass();
    if (chosen.pass() && is_lighter) lightest = chosen;
    if (nearest && !(use < least_use)) continue;
    nearest = std::move(chosen);
    least_use = use;
  }
  return lightest ? *lightest : *nearest;
}

}  // namespace blocklift::pipeline
