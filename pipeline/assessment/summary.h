#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/assessment/assessment.h"

namespace blocklift::pipeline {

/// summary.json: what pipeline/formats/results_layout.h says about it. Figures that are not known are
/// null, so that the file is always valid JSON.
nlohmann::ordered_json make_summary(const Assessment& assessment);

}  // namespace blocklift::pipeline
