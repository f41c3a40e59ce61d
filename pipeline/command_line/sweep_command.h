#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What `blocklift sweep` is told.
struct SweepOptions {
  std::string study;
  std::optional<std::string> output;  ///< folder of the results
  int workers = 0;  ///< lifts side by side; 0: as many as the machine has processors,
                    ///< of several processes one of each
  std::optional<std::string> worker_of;  ///< answers the orders of a study of that identity
  std::optional<std::string> part;       ///< "3/10": the third of ten parts of the members, alone
  std::optional<std::string> slurm;      ///< "submit" or "write": runs as jobs of Slurm
  int parts = 0;                         ///< of those; 0: ten, or as many as there are members
  std::vector<std::string> sbatch;       ///< more options of theirs
  std::vector<std::string> join;         ///< folders of parts whose members are taken over
  std::optional<int> whole;              ///< a member whose whole results are written
};

/// `blocklift sweep STUDY`: many lifts of one case, and what their figures say together. On several
/// processes (`mpirun -n N`) the first hands out members, and it alone writes.
/// @returns the exit code: 1 if no member ran. @throws InputError.
int sweep(const SweepOptions& options);

}  // namespace blocklift::pipeline
