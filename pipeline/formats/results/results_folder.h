#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// What is wrong with a file of results.
struct FileComplaint {
  std::filesystem::path file;
  std::string message;  ///< without the file's name
};

/// Reads the results in a folder, which may be damaged or made by others, and holds them against
/// results_layout.h. results.h5 is read in a child process, since HDF5 crashes on damaged files.
/// @returns what is wrong with summary.json and results.h5; nothing if both can be used.
std::vector<FileComplaint> complaints_about_folder(const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
