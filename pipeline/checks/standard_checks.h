#pragma once

#include <vector>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// A line for each chain that is held against a limit: by the standard's column or that of the
/// simulation, whichever uses more.
std::vector<Check> checks_of(const StandardAssessment& standard);

/// Works the rules that the case names, if any, and adds their checks.
void check_by_standard(Assessment& assessment);

}  // namespace blocklift::pipeline
