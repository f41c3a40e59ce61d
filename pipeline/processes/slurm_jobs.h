#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// A study as jobs of Slurm: an array, each task of which computes a part, and a job that joins
/// the parts once all have ended well.
struct SlurmJobs {
  std::string study;                ///< its file, from the working folder
  std::string name;                 ///< of the study, and of the jobs
  std::filesystem::path folder;     ///< of the results
  int parts = 1;                    ///< tasks of the array
  int workers = 1;                  ///< processors of each
  std::vector<std::string> sbatch;  ///< more options of both jobs: "--partition=long"
};

/// Writes the jobs' scripts into a folder "slurm" of the results.
/// @returns the script that submits both.
std::filesystem::path write_slurm_jobs(const SlurmJobs& jobs);

/// Whether jobs can be submitted from this machine.
bool is_slurm_here();

/// Submits both. @throws std::runtime_error if Slurm takes them not.
void submit_slurm_jobs(const std::filesystem::path& script);

}  // namespace blocklift::pipeline
