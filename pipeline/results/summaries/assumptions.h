#pragma once

#include <string>
#include <vector>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// What the figures of an assessment rest on, a sentence each, for the engineer who signs.
std::vector<std::string> list_assumptions(const Assessment& assessment);

}  // namespace blocklift::pipeline
