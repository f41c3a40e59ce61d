#pragma once

#include <string>

#include "pipeline/files/lift_case.h"

namespace blocklift::pipeline {

/// Fingerprint of all that a lift's figures depend on: the case file, the model files that it
/// names, and the block's mesh where another file holds it (with what that includes). Comments and
/// blanks count: a file that was touched is another input. 32 hexadecimal digits.
std::string hash_of_input(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
