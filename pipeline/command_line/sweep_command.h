#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift sweep` is told.
struct SweepOptions {
  std::string study;
  std::optional<std::string> output;  ///< folder of the results
  int workers = 0;                    ///< processes side by side; 0: as many as the machine has
  bool is_worker = false;             ///< computes members until none is left
  std::optional<int> blocks;          ///< prepares every so-many-th block of the members, from here
  std::optional<std::string> part;    ///< "3/10": the third of ten parts of the members, alone
  std::vector<std::string> join;      ///< folders of parts whose members are taken over
  std::optional<int> whole;           ///< a member whose whole results are written
};

/// `blocklift sweep STUDY`: many lifts of one case, and what their figures say together.
/// @returns the exit code: 1 if no member ran. @throws InputError.
int sweep(const SweepOptions& options);

}  // namespace blocklift::pipeline
