#pragma once

#include <filesystem>
#include <functional>

namespace blocklift::pipeline {

/// Keeps other runs from computing what this one computes: a lock on a file beside an entry of the
/// cache (flock), which the system lets go of with the process, whatever ends it.
///
/// A second run waits until the first has put its database there, or has ended without. Where the
/// file cannot be made, or its file system knows no locks, nothing is locked and nobody waits:
/// databases are computed twice then.
class CacheLock {
 public:
  /// @param entry the file of the cache; its lock is the file of this name with `.lock` added.
  /// @param wait called once before the constructor waits for another run.
  CacheLock(const std::filesystem::path& entry, const std::function<void()>& wait);
  ~CacheLock();
  CacheLock(const CacheLock&) = delete;
  CacheLock& operator=(const CacheLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace blocklift::pipeline
