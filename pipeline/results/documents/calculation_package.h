#pragma once

#include <string>

#include "pipeline/checks/assessment.h"
#include "pipeline/results/documents/text_document.h"

namespace blocklift::pipeline {

/// The calculation of a lift by a standard, in the order in which a warranty surveyor asks for it
/// (GL Noble Denton 0027/ND rev. 11.2, appendix A): basis, weights, rigging list, geometry, load
/// cases, utilisations, chains of factors, revision with the hash of the case, and boxes to sign.
/// The assessment has a standard.
TextDocument calculation_package(const Assessment& assessment);

/// What stands at the foot of its pages: case, project, revision and the hash of input and factors.
std::string calculation_foot(const Assessment& assessment);

/// What its files are called, beside the report: as Markdown, and for Word.
inline constexpr const char* package_file = "calculation.md";
inline constexpr const char* package_word_file = "calculation.docx";

}  // namespace blocklift::pipeline
