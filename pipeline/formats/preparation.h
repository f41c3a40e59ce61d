#pragma once

#include <filesystem>
#include <vector>

namespace blocklift::pipeline {

/// A folder within that of the results in which they are prepared; gone with everything in it
/// unless moved, and so are the folders that were made for it.
class Preparation {
 public:
  /// @throws std::filesystem::filesystem_error if a folder cannot be made.
  explicit Preparation(const std::filesystem::path& folder);
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  const std::filesystem::path& folder() const { return aside_; }
  /// Each file takes the place of an older one of its name, in one step. A summary.json comes last,
  /// and an older one goes first: a folder with a summary is whole.
  /// @throws std::filesystem::filesystem_error if a file cannot be moved.
  void move_into_place() const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path aside_;
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace blocklift::pipeline
