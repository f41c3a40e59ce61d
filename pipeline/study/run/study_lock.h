#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// Keeps a second run of a study out of its folder of results while a first is at work there: both
/// would compute the same members, and each would clear away the pages that the other prepares. A
/// lock on a file beside the members (flock), which the system lets go of with the process,
/// whatever ends it. Parts of a study may be at work in one folder together: they write their
/// members alone. Who is alone there clears away what runs that were killed left half-written.
///
/// Where the file cannot be made, or its file system knows no locks, nobody is kept out.
class StudyLock {
 public:
  enum class Use { whole, part };

  /// @throws InputError if another run is at work in the folder.
  StudyLock(const std::filesystem::path& folder, Use use);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace blocklift::pipeline
