#pragma once

#include <optional>
#include <string>

namespace blocklift::pipeline {

/// What `blocklift stress` is asked for.
struct StressOptions {
  std::string part;                   ///< file of the part, or of a block with a deck
  std::optional<std::string> output;  ///< folder of the results; results/<name of the part>
  bool calculix = false;              ///< write an input of CalculiX, too
  std::optional<int> degree;          ///< of a deck's elements
};

/// Solves a part, or the load cases of a block's deck, writes the results and prints a table.
/// @returns the exit code.
/// @throws InputError as assess_part and assess_deck do, or if an option is for the other of them.
int stress(const StressOptions& options);

}  // namespace blocklift::pipeline
