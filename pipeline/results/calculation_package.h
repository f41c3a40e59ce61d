#pragma once

#include <string>

#include "pipeline/checks/assessment.h"

namespace blocklift::pipeline {

/// The calculation of a lift by a standard as Markdown, in the order in which a warranty surveyor
/// asks for it (GL Noble Denton 0027/ND rev. 11.2, appendix A): basis, weights, rigging list,
/// geometry, load cases, chains of factors, utilisations, revision with the hash of the case, and
/// boxes to sign. The assessment has a standard.
std::string calculation_package(const Assessment& assessment);

/// What its file is called, beside the report.
inline constexpr const char* package_file = "calculation.md";

}  // namespace blocklift::pipeline
