#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/rigging/sling_choice.h"
#include "pipeline/rigging/stock.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// A shackle that was chosen for the lug of a sling.
struct ChosenShackle {
  std::string lug;
  std::optional<std::size_t> index;  ///< in the stock; none: the stock has no shackles
  std::vector<Check> checks;
  bool pass() const { return index && all_pass(checks); }
};

/// The weakest shackle that passes: its working load against the sling's largest tension at rest, or
/// what three legs or more on its hook ask (demand_with_legs);
/// where the case's rules have shackles, their chains, at rest and in motion. Where none passes,
/// the strongest.
/// @param facts of the run, where the case has a standard.
ChosenShackle choose_shackle(const Stock& stock, const LiftCase& lift_case,
                             const std::optional<LiftFacts>& facts, const SlingDemand& demand);

}  // namespace blocklift::pipeline
