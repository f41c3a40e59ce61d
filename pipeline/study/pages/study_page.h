#pragma once

#include <string>

#include "pipeline/study/results/study_results.h"

namespace blocklift::pipeline {

/// The page: leading figures with exceedance, what they depend on, all figures.
std::string study_page(const StudyResults& results);

}  // namespace blocklift::pipeline
