#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// Removes what writers of files in a folder (AtomicFile) have left that were killed. Nobody may be
/// writing there.
void remove_unfinished_files(const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
