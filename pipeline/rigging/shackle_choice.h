#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/rigging/leg_sharing.h"
#include "pipeline/rigging/stock.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// What a run asks of the shackle at a lug.
struct ShackleDemand {
  std::string lug;
  double at_rest = 0;    ///< largest load of the equilibria, of all slings at the lug together, N
  SharedHook hook = {};  ///< of those that these slings hang from, the one that asks most of a leg
};

/// A shackle that was chosen for a lug.
struct ChosenShackle {
  std::string lug;
  std::optional<std::size_t> index;  ///< in the stock; none: the stock has no shackles
  std::vector<Check> checks;
  bool pass() const { return index && all_pass(checks); }
};

/// The weakest shackle that passes: its working load against the largest load at rest, or what the
/// legs on its hook ask (demand_with_legs); where the case's rules have shackles, their chains, at
/// rest and in motion. Where none passes, the strongest.
/// @param facts of the run, where the case has a standard.
ChosenShackle choose_shackle(const Stock& stock, const LiftCase& lift_case,
                             const std::optional<LiftFacts>& facts, const ShackleDemand& demand);

/// Those of all lugs at which slings without a winch of their own end.
std::vector<ShackleDemand> shackle_demands(const LiftCase& lift_case, const LiftRun& lift);

}  // namespace blocklift::pipeline
