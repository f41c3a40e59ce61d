#pragma once

#include <vector>

#include "pipeline/files/library/model_library.h"
#include "pipeline/verification/verification.h"

namespace blocklift::pipeline {

/// Every case of the verification suite, stage by stage. A stage is entered here and nowhere else.
/// @param library where the mechanisms of benchmarks are found.
/// @throws InputError if a benchmark's reference cannot be read.
std::vector<VerificationCase> verification_suite(const ModelLibrary& library);

}  // namespace blocklift::pipeline
