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

/// A spreader bar that was chosen.
struct ChosenSpreader {
  std::string name;       ///< of the bar in the case
  std::size_t index = 0;  ///< in the stock
  std::vector<Check> checks;
  bool pass() const { return all_pass(checks); }
};

/// Has the stock bars of that length, within a millimetre? A longer one would be another rigging.
bool has_bars_of_length(const Stock& stock, double length);

/// The lightest bar of the stock, of the length that the case's bar has, that passes: as a column
/// under the forces of its ropes at every instant, at rest and in motion, by the case's factor; by the
/// case's rules, where it names some; by its working load against what hangs below it at rest. Where
/// none passes, the one that comes nearest.
/// @param facts of the lift; none where the case names no rules.
/// @pre has_bars_of_length for that bar.
ChosenSpreader choose_spreader(const Stock& stock, const LiftCase& lift_case, const LiftRun& lift,
                               const std::optional<LiftFacts>& facts, const std::string& name);

/// The checks of that choice: of the bar `index` of the stock in the place of the case's.
std::vector<Check> check_spreader(const SpreaderInStock& candidate, const LiftCase& lift_case,
                                  const LiftRun& lift, const std::optional<LiftFacts>& facts,
                                  const std::string& name);

}  // namespace blocklift::pipeline
