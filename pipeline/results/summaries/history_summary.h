#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/lift/history_assessment.h"

namespace blocklift::pipeline {

/// `structure.history` of summary.json, as results_layout.h says.
nlohmann::ordered_json history_json(const HistoryAssessment& history);

}  // namespace blocklift::pipeline
