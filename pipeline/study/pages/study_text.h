#pragma once

#include <string>

#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// A table of the leading figures for a terminal.
std::string study_text(const StudyResults& results);

}  // namespace blocklift::pipeline
