#pragma once

#include <optional>
#include <string>

namespace blocklift::pipeline {

/// What `blocklift stress` is asked for.
struct StressOptions {
  std::string part;                   ///< file of the part
  std::optional<std::string> output;  ///< folder of the results; results/<name of the part>
  bool calculix = false;              ///< write an input of CalculiX, too
};

/// Solves a part, writes its results and prints a table. @returns the exit code.
/// @throws InputError as assess_part does.
int stress(const StressOptions& options);

}  // namespace blocklift::pipeline
