#pragma once

#include <functional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// summary.json: what pipeline/formats/results/results_layout.h says about it. Figures that are not
/// known are null, so that the file is always valid JSON.
nlohmann::ordered_json make_summary(const Assessment& assessment);

/// summary.json of a lift that is simulated without its structure: neither checks nor a verdict.
nlohmann::ordered_json make_simulation_summary(const LiftCase& lift_case, const LiftRun& lift,
                                               const std::vector<LiftMeasure>& measures);

/// Is a part of a summary wanted? By its key: "ropes", "energy".
using WantedParts = std::function<bool(std::string_view part)>;

/// The wanted ones of those parts of a simulation's summary that hold figures; parts that cost
/// nothing are always there. The run has what they are made of: RunExtent. Of `ropes`, `hoists` and
/// `cranes` those values are left out that the run has not found, loads at rest or swing.
nlohmann::ordered_json make_simulation_figures(const LiftCase& lift_case, const LiftRun& lift,
                                               const std::vector<LiftMeasure>& measures,
                                               const WantedParts& wanted);

/// The table "solver": what the integration of `simulated_s` seconds cost, done in `elapsed_s` of
/// wall-clock time.
nlohmann::ordered_json solver_json(const dynamics::IntegrationStatistics& statistics,
                                   double simulated_s, double elapsed_s);

}  // namespace blocklift::pipeline
