#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <utility>

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

/// What `read` finds of an entry of the cache, or what `compute` makes and `write` puts there. What
/// another run is making is waited for.
/// @param read gives an optional: none if the entry is not there, or of no use.
/// @param wait called before another run is waited for.
template <class Read, class Compute, class Write>
auto take_or_make(const std::filesystem::path& file, const Read& read,
                  const std::function<void()>& wait, const Compute& compute, const Write& write) {
  if (auto known = read()) return std::move(*known);
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  const CacheLock lock(file, wait);
  // The other run may have been waited for.
  if (auto known = read()) return std::move(*known);
  auto made = compute();
  try {
    write(made);
  } catch (const std::runtime_error&) {
    // What cannot be kept is made again.
  }
  return made;
}

}  // namespace blocklift::pipeline
