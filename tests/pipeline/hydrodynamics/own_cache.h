#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline::test {

/// The cache is a folder of its own while this lives.
class OwnCache {
 public:
  OwnCache() {
    if (const char* before = std::getenv("BLOCKLIFT_CACHE")) before_ = before;
    ::setenv("BLOCKLIFT_CACHE", folder_.path().c_str(), 1);
  }
  ~OwnCache() {
    if (before_.empty()) {
      ::unsetenv("BLOCKLIFT_CACHE");
    } else {
      ::setenv("BLOCKLIFT_CACHE", before_.c_str(), 1);
    }
  }
  OwnCache(const OwnCache&) = delete;
  OwnCache& operator=(const OwnCache&) = delete;

  std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".h5") files.push_back(entry.path());
    }
    return files;
  }

 private:
  TemporaryFolder folder_;
  std::string before_;
};

}  // namespace blocklift::pipeline::test
