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

/// A sheave that was chosen for a sling that is led over one.
struct ChosenSheave {
  std::string rope;
  std::optional<std::size_t> index;  ///< in the stock; none: no groove takes the sling
  std::vector<Check> checks;
  bool pass() const { return index && all_pass(checks); }
};

/// Is a rope of the case led over anything between its ends?
bool is_led_over_sheaves(const given::Rope& rope);

/// The weakest sheave whose groove takes the sling and that passes: with a standard its chains, at
/// rest and in motion, else its working load against twice the largest tension at rest. Where none
/// passes, the strongest that takes the sling. A sling without a diameter fits none.
/// @param facts of the run, where the case has a standard.
ChosenSheave choose_sheave(const Stock& stock, const LiftCase& lift_case,
                           const std::optional<LiftFacts>& facts, const SlingDemand& demand,
                           const RopeModel& sling);

}  // namespace blocklift::pipeline
