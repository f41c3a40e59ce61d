#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"
#include "pipeline/rigging/stock.h"
#include "pipeline/standards/lift_facts.h"

namespace blocklift::pipeline {

/// What a run asks of the master link at a hook from which several slings hang.
struct MasterLinkDemand {
  std::string hook;    ///< "C1.main"
  int legs = 0;        ///< slings that begin at the hook
  double at_rest = 0;  ///< largest load below the hook block of the equilibria, N
};

/// A master link that was chosen for a hook.
struct ChosenMasterLink {
  MasterLinkDemand demand;
  std::size_t index = 0;  ///< in the stock
  std::vector<Check> checks;
  bool pass() const { return all_pass(checks); }
};

/// The hooks of the case from which several slings hang.
std::vector<MasterLinkDemand> master_link_demands(const LiftCase& lift_case, const LiftRun& lift);

/// The weakest link that passes: with a standard its chains, at rest and in motion, else its
/// working load against the largest load at rest. Where none passes, the strongest.
/// @param facts of the run, where the case has a standard.
/// @returns none where the stock has no master links.
std::optional<ChosenMasterLink> choose_master_link(const Stock& stock, const LiftCase& lift_case,
                                                   const std::optional<LiftFacts>& facts,
                                                   const MasterLinkDemand& demand);

}  // namespace blocklift::pipeline
