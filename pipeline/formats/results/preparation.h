#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// A folder within that of the results in which they are prepared; gone with everything in it
/// unless moved, and so are the folders that were made for it.
class Preparation {
 public:
  /// Completes an earlier move that was stopped (complete_stopped_move) before anything else.
  /// @throws std::filesystem::filesystem_error if a folder cannot be made.
  explicit Preparation(const std::filesystem::path& folder);
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  const std::filesystem::path& folder() const { return aside_; }
  /// Each file takes the place of an older one of its name, and the older ones of `absent` go: all
  /// of them or, if a file cannot be moved, none. Summary and pages of the earlier run leave first
  /// and those of this one come last, so that a folder with a verdict is whole at every instant.
  /// Whoever is stopped in between (power, kill -9) leaves a list of what is to be moved, by which
  /// complete_stopped_move goes on.
  /// @param absent names of files that a run of this kind may have, and that this one has not.
  /// @throws std::runtime_error if the list cannot be written,
  ///   std::filesystem::filesystem_error if a file cannot be moved.
  void move_into_place(const std::vector<std::string>& absent = {});

 private:
  std::filesystem::path folder_;
  std::filesystem::path aside_;
  std::vector<std::filesystem::path> made_;  ///< the innermost first
  bool is_kept_ = false;  ///< where earlier files could not be brought back: they lie in there
};

/// Brings results into place whose move was stopped between two files; otherwise does nothing.
/// @throws std::filesystem::filesystem_error if a file cannot be moved.
void complete_stopped_move(const std::filesystem::path& folder);

}  // namespace blocklift::pipeline
