#include "structure/outside_files.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace blocklift::structure {

namespace fs = std::filesystem;

namespace {

/// Without symbolic links, "." and ".."; empty if that cannot be found out.
fs::path followed(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path.empty() ? fs::path(".") : path, error);
  if (error) return {};
  // Twice: behind a folder that does not exist the first leaves links as they are.
  fs::path canonical = fs::weakly_canonical(fs::weakly_canonical(whole, error), error);
  if (error) return {};
  return canonical.has_filename() ? canonical : canonical.parent_path();
}

}  // namespace

void allow_files_outside() { ::setenv(allow_outside_variable, "1", 1); }

bool are_files_outside_allowed() {
  const char* value = std::getenv(allow_outside_variable);
  return value != nullptr && std::string_view(value) == "1";
}

bool leads_into(const fs::path& path, const std::vector<fs::path>& folders) {
  const fs::path end = followed(path);
  if (end.empty()) return false;
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    const fs::path root = followed(folder);
    return !root.empty() &&
           std::mismatch(root.begin(), root.end(), end.begin(), end.end()).first == root.end();
  });
}

}  // namespace blocklift::structure
