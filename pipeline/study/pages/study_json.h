#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// study.json: the spreads, with units as the names of the figures have them.
nlohmann::ordered_json study_json(const StudyResults& results);

}  // namespace blocklift::pipeline
