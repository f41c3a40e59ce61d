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

/// A spreader that was chosen.
struct ChosenSpreader {
  std::string name;       ///< of the spreader in the case
  std::size_t index = 0;  ///< in the stock
  std::vector<Check> checks;
  bool pass() const { return all_pass(checks); }
};

/// Has the stock spreaders of that size, bars of its length or frames of its length and width,
/// within a millimetre? A larger one would be another rigging.
bool has_spreaders_of_size(const Stock& stock, const given::Spreader& in_case);

/// The lightest spreader of the stock, of the size that the case's has, that passes: by its
/// strength under the forces of its ropes at every instant, at rest and in motion, by the case's
/// factor; by the case's rules, where it names some; by its working load against what hangs below
/// it at rest. Where none passes, the one that comes nearest.
/// @param facts of the lift; none where the case names no rules.
/// @pre has_spreaders_of_size for that spreader.
ChosenSpreader choose_spreader(const Stock& stock, const LiftCase& lift_case, const LiftRun& lift,
                               const std::optional<LiftFacts>& facts, const std::string& name);

/// The checks of that choice: of the stock's spreader in the place of the case's.
std::vector<Check> check_spreader(const SpreaderInStock& candidate, const LiftCase& lift_case,
                                  const LiftRun& lift, const std::optional<LiftFacts>& facts,
                                  const std::string& name);

}  // namespace blocklift::pipeline
