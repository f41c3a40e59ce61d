#include "pipeline/checks/standard_checks.h"

#include <utility>

#include <fmt/format.h>

#include "pipeline/checks/gather_facts.h"

namespace blocklift::pipeline {

std::vector<Check> checks_of(const StandardAssessment& standard) {
  std::vector<Check> checks;
  for (const Chain& chain : standard.chains) {
    if (!chain.has_limit()) continue;
    const bool by_motion = chain.simulated_utilisation() > chain.standard_utilisation();
    Check check = check_at_most(
        fmt::format("{}: {} by {}", standard.name, chain.object, chain.limit_text),
        by_motion ? chain.simulated : chain.standard,
        by_motion ? chain.simulated_limit.value_or(*chain.limit) : *chain.limit, chain.unit);
    check.is_of_standard = true;
    check.note = fmt::format("{:.3f} by the factors of the standard, {:.3f} by the simulation; {}",
                             chain.standard_utilisation(), chain.simulated_utilisation(),
                             chain.limit_clause);
    checks.push_back(std::move(check));
  }
  return checks;
}

void check_by_standard(Assessment& assessment) {
  const auto& standard = assessment.lift_case.standard;
  if (!standard) return;
  assessment.standard = assess_standard(*standard, gather_facts(assessment));
  for (Check& check : checks_of(*assessment.standard))
    assessment.checks.push_back(std::move(check));
}

}  // namespace blocklift::pipeline
