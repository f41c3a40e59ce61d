#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/standards/standard_assessment.h"

namespace blocklift::pipeline {

/// `standard` of summary.json: the rules, what the comparison shows, one row of utilisations a
/// chain, and the chains step by step.
nlohmann::ordered_json standard_json(const StandardAssessment& standard);

/// The utilisations and what the comparison shows, for a terminal.
std::string standard_text(const StandardAssessment& standard);

}  // namespace blocklift::pipeline
