#pragma once

#include <filesystem>
#include <vector>

namespace blocklift::structure {

/// The variable of the environment that, at 1, allows input to name files anywhere. Processes that
/// a run starts inherit it.
constexpr const char* allow_outside_variable = "BLOCKLIFT_ALLOW_OUTSIDE";

/// Sets the variable: input may name files anywhere from now on, in this process and those that it
/// starts.
void allow_files_outside();
bool are_files_outside_allowed();

/// Whether a path leads into one of the folders, or is one of them: ".." and symbolic links are
/// followed, of the folders too. Where nothing stands yet the path is taken as it is written.
bool leads_into(const std::filesystem::path& path,
                const std::vector<std::filesystem::path>& folders);

}  // namespace blocklift::structure
