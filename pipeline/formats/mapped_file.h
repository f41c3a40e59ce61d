#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace blocklift::pipeline {

/// The bytes of a file that is only read, in memory that all processes which read it share. Not for
/// files that others change in place; to be replaced they may be.
class MappedFile {
 public:
  /// @throws std::runtime_error if it cannot be read.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace blocklift::pipeline
