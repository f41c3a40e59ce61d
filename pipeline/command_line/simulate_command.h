#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift simulate FILE` is asked for.
struct SimulateOptions {
  std::string path;  ///< mechanism file, robot description, lift case, or a folder of one
  std::optional<std::string> output;  ///< folder; results/<name> if none
  bool csv = false;                   ///< a CSV file beside the HDF5 one
  std::vector<std::string> set = {};  ///< keys with other values, as read_asked_changes takes them
  bool anew = false;                  ///< nothing is taken from the cache or put there
};

/// `blocklift simulate FILE`: the motion of a mechanism or lift case into results.h5.
/// @returns the exit code: 0. What goes wrong is thrown: InputError for the input, anything else
///   for the run.
int simulate_file(const SimulateOptions& options);

}  // namespace blocklift::pipeline
