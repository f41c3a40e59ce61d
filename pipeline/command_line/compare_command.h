#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift compare` is told.
struct CompareOptions {
  std::vector<std::string> results;      ///< folders of results, or cases
  std::optional<std::string> tolerance;  ///< a list of figure=tolerance, or a file
  std::optional<std::string> page;       ///< an HTML page to write
  bool json = false;
};

/// `blocklift compare A B [C ...]`: results beside each other.
/// @returns the exit code: 3 if a figure moved beyond its tolerance. @throws InputError.
int compare(const CompareOptions& options);

}  // namespace blocklift::pipeline
