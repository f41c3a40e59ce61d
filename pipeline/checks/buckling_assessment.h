#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/checks.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/lift/history_assessment.h"
#include "structure/practice/bar_buckling.h"
#include "structure/practice/panel_buckling.h"

namespace blocklift::pipeline {

/// A panel at the instant at which it is nearest to buckling, of both histories.
struct BuckledPanel {
  structure::Panel panel;
  structure::BlockPanels::Worst worst;
  bool in_motion = false;      ///< in the dynamic history, else in the static one
  std::optional<double> time;  ///< s; none for a load table
};

/// A span of a bar or stiffener at the instant at which it bears most as a column, of both
/// histories.
struct BuckledBar {
  structure::BarSpan span;
  structure::BlockBars::Worst worst;
  bool in_motion = false;      ///< in the dynamic history, else in the static one
  std::optional<double> time;  ///< s; none for a load table
  /// Of a stiffener that trips, at the instant of that.
  structure::BlockBars::WorstTripping tripping = {};
  bool trips_in_motion = false;
  std::optional<double> tripping_time = {};
};

/// Every panel, stiffener and bar that stands free of plates over the whole lift.
struct BucklingAssessment {
  std::vector<BuckledPanel> panels;  ///< the nearest to buckling first
  std::vector<BuckledBar> bars;      ///< the nearest first, under forces times bar_factor
  double bar_factor = 1;
  int unknown_rods = 0;     ///< without second moments, not looked at
  double evaluation_s = 0;  ///< wall-clock time
};

/// Stiffeners without a profile, which the mesh does not have and which divide panels all the same.
/// Those with one divide panels where their beams or webs stand, and nowhere else.
std::vector<structure::PlateStiffening> stiffening_beside_mesh(const BlockModel& block);

/// Looks at every panel and bar at every instant of both histories.
BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const HistoryAssessment& history);

/// The same for the two states of a load table.
BucklingAssessment assess_buckling(const LiftCase& lift_case,
                                   const structure::UnitResponses& responses,
                                   const BlockAssessment& block);

/// A line for each name of plates: its panel that is nearest to buckling, critical stresses by
/// Johnson and Ostenfeld, against 1 over the case's buckling factor. Then one for each name of bars
/// and of stiffeners: what its worst span bears over what it may bear as a column, forces times
/// that factor. Last one for each name of stiffeners that trip.
std::vector<Check> check_buckling(const LiftCase& lift_case, const BucklingAssessment& buckling);

/// `structure.buckling` of summary.json: the first panels and bars; all of them are in results.h5.
nlohmann::ordered_json buckling_json(const BucklingAssessment& buckling);

/// All panels and bars, where results_layout.h has them.
void write_buckling(ResultsWriter& file, const BucklingAssessment& buckling);

}  // namespace blocklift::pipeline
