#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// summary.json: what pipeline/formats/results/results_layout.h says about it. Figures that are not
/// known are null, so that the file is always valid JSON.
nlohmann::ordered_json make_summary(const Assessment& assessment);

/// summary.json of a lift that is simulated without its structure: neither checks nor a verdict.
nlohmann::ordered_json make_simulation_summary(const LiftCase& lift_case, const LiftRun& lift,
                                               const std::vector<LiftMeasure>& measures);

/// The table "solver": what the integration of `simulated_s` seconds cost, done in `elapsed_s` of
/// wall-clock time.
nlohmann::ordered_json solver_json(const dynamics::IntegrationStatistics& statistics,
                                   double simulated_s, double elapsed_s);

}  // namespace blocklift::pipeline
