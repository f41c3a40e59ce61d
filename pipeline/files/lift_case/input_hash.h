#pragma once

#include <string>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// Fingerprint of all that a lift's figures depend on: the case file, the model files that it
/// names, the files of the block's mesh (with what they include), the hulls as they were read, the
/// databases of vessels, the record of waves, and measured series. All as they were when the case
/// was read. Comments and blanks count: a file that was touched is another input. 32 hexadecimal
/// digits.
std::string hash_of_input(const LiftCase& lift_case);

}  // namespace blocklift::pipeline
