#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/checks/padeye_assessment.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// A hand formula at its worst. Not finite numbers are null.
nlohmann::ordered_json formula_json(const PadeyeFormulaAtWorst& at_worst);

/// `structure.padeyes` of summary.json, as results_layout.h says.
nlohmann::ordered_json padeyes_json(const PadeyesAssessment& padeyes);

/// Stress of each padeye's columns at its governing state, where results_layout.h has it.
void write_padeyes(ResultsWriter& file, const PadeyesAssessment& padeyes);

/// What a padeye's file for ParaView is called: lug-L1.vtu.
std::string padeye_file(const PadeyeAssessment& padeye);

}  // namespace blocklift::pipeline
