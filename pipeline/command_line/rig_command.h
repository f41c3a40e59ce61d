#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `rig` is asked.
struct RigOptions {
  std::string path;
  std::optional<std::string> stock;        ///< folder; none: the shipped one
  std::vector<std::string> constructions;  ///< that slings may have; none: see the manual
  std::optional<std::string> output;       ///< file of the case with the chosen slings
};

/// Names of constructions as files of stock have them.
std::vector<std::string> construction_names();

/// Chooses slings and shackles from stock for a case, prints them, and writes the case with them.
/// @returns an exit code: 3 where no stock passes, 1 where the choice does not stand.
int rig(const RigOptions& options);

}  // namespace blocklift::pipeline
