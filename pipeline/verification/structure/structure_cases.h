#pragma once

#include <vector>

#include "pipeline/files/library/model_library.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Cases of the structure.
/// @param library where parts with references are found.
/// @throws InputError if one of them cannot be read.
std::vector<VerificationCase> structure_cases(const ModelLibrary& library);

/// One case for each parts/<name>/part.yaml and lugs/<name>/part.yaml of the models that has
/// references.
std::vector<VerificationCase> part_cases(const ModelLibrary& library);

/// Superposition, balance and envelope of a small block on four lugs.
VerificationCase lifted_block();
/// The estimated error of parts over the true one, and the accuracy that refinement reaches.
VerificationCase error_estimate(const ModelLibrary& library);

}  // namespace blocklift::pipeline
