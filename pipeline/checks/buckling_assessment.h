#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/lift/history_assessment.h"
#include "structure/practice/panel_buckling.h"

namespace blocklift::pipeline {

/// A panel at the instant at which it is nearest to buckling, of both histories.
struct BuckledPanel {
  structure::Panel panel;
  structure::BlockPanels::Worst worst;
  bool in_motion = false;      ///< in the dynamic history, else in the static one
  std::optional<double> time;  ///< s; none for a load table
};

/// Every panel of the block over the whole lift.
struct BucklingAssessment {
  std::vector<BuckledPanel> panels;  ///< the nearest to buckling first
  double evaluation_s = 0;           ///< wall-clock time
};

/// Looks at every panel at every instant of both histories.
BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const HistoryAssessment& history);

/// The same for the two states of a load table.
BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const BlockAssessment& block);

/// A line for each name of plates: its panel that is nearest to buckling, critical stresses by
/// Johnson and Ostenfeld, against 1 over the case's buckling factor.
std::vector<Check> check_buckling(const LiftCase& lift_case, const BucklingAssessment& buckling);

/// `structure.buckling` of summary.json: the first panels; all of them are in results.h5.
nlohmann::ordered_json buckling_json(const BucklingAssessment& buckling);

/// All panels, where results_layout.h has them.
void write_buckling(ResultsWriter& file, const BucklingAssessment& buckling);

}  // namespace blocklift::pipeline
