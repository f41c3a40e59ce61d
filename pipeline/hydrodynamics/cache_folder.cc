#include "pipeline/hydrodynamics/cache_folder.h"

#include <cstdlib>

namespace blocklift::pipeline {

std::filesystem::path cache_folder() {
  namespace fs = std::filesystem;
  if (const char* folder = std::getenv("BLOCKLIFT_CACHE")) return folder;
  if (const char* folder = std::getenv("XDG_CACHE_HOME")) return fs::path(folder) / "blocklift";
  if (const char* home = std::getenv("HOME")) return fs::path(home) / ".cache" / "blocklift";
  return {};
}

}  // namespace blocklift::pipeline
