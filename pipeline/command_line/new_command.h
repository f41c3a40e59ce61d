#pragma once

#include <string>

namespace blocklift::pipeline {

/// `blocklift new KIND FOLDER`: writes a commented case that runs and says how.
/// @returns the exit code. @throws InputError if the folder is there or there is no such kind.
int write_new(const std::string& kind, const std::string& folder);

}  // namespace blocklift::pipeline
