#pragma once

#include <string>

#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// What a search found, for a terminal.
std::string search_text(const StudyResults& results);
/// The same for the page: the best member, its bounds, how it was found.
std::string search_section(const StudyResults& results);

}  // namespace blocklift::pipeline
