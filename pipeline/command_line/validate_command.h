#pragma once

#include <string>
#include <vector>

namespace blocklift::pipeline {

/// `blocklift validate FILE...`: reads lift cases and model files with everything that they name,
/// and says what is wrong with them, on standard error. Writes no file.
/// @returns the exit code: 0 if all are sound, 2 if any is not.
int validate_files(const std::vector<std::string>& files);

}  // namespace blocklift::pipeline
