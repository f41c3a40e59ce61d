#pragma once

#include <CLI/CLI.hpp>

namespace blocklift::pipeline {

/// Adds the options by which a run is kept within bounds: --time, --memory and --threads.
///
/// They act as they are read, before the command's own work. A run that would need more memory says
/// so with figures before it begins to use it; one that takes longer ends with exit code 1 and a
/// message that says where it stood, and leaves earlier results as they were.
/// @param with_memory false for commands that have their own option.
void add_limits(CLI::App& command, bool with_memory = true);

/// While it lives the limit of time does not end the run: results are being moved into place.
class NoEndOfTime {
 public:
  NoEndOfTime();
  ~NoEndOfTime();
  NoEndOfTime(const NoEndOfTime&) = delete;
  NoEndOfTime& operator=(const NoEndOfTime&) = delete;
};

}  // namespace blocklift::pipeline
