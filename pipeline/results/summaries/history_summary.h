#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/lift/history_assessment.h"
#include "pipeline/lift/stage_stresses.h"

namespace blocklift::pipeline {

/// `structure.history` of summary.json, as results_layout.h says.
nlohmann::ordered_json history_json(const HistoryAssessment& history);

/// `structure.stages` of summary.json: the block stage by stage.
nlohmann::ordered_json stage_stresses_json(const std::vector<StageStress>& stages);

}  // namespace blocklift::pipeline
