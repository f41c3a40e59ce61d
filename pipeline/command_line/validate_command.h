#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// `blocklift validate FILE...`: reads lift cases and model files with everything that they name,
/// and says what is wrong with them, on standard error. Of a folder that holds a case and a
/// study.yaml both are read, the case alone where keys are set.
/// @param pictures folder that receives a page for each block of a mesh, of what was found in it,
///   <name of the file>.html; none: no file is written.
/// @param set keys of the cases and mechanisms that are to have other values, as read_asked_changes
///   takes them.
/// @returns the exit code: 0 if all are sound, 2 if any is not.
int validate_files(const std::vector<std::string>& files,
                   const std::optional<std::string>& pictures, const std::vector<std::string>& set);

}  // namespace blocklift::pipeline
