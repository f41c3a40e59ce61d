#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace blocklift::pipeline {

/// A file that appears whole or not at all.
///
/// The content is written to temporary_path(), a hidden name in the same folder as the final one;
/// commit() flushes it to the disk and renames it into place, which POSIX does in one step, so that
/// a reader sees the old file or the new one and never a part. Without commit() (an exception, say)
/// the destructor removes the temporary file and an older file of the final name stays untouched.
class AtomicFile {
 public:
  /// Creates the folders of `path` where they are missing.
  /// @throws std::runtime_error if `path` is a folder or its folder cannot be made.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& temporary_path() const { return temporary_path_; }

  /// Writes the whole content.
  /// @throws std::runtime_error with the file's name and the system's reason.
  void write(std::string_view content) const;
  /// To be called once, after the content is written and the temporary file is closed.
  /// @throws std::runtime_error with the file's name and the system's reason.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  bool committed_ = false;
};

/// Writes `content` as the whole of file `path`, by way of AtomicFile.
/// @throws std::runtime_error with the file's name and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The whole content of a file.
/// @throws std::runtime_error with the file's name and the system's reason.
std::string read_file(const std::filesystem::path& path);

}  // namespace blocklift::pipeline
