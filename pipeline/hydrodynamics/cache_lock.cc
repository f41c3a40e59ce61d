#include "pipeline/hydrodynamics/cache_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace blocklift::pipeline {

CacheLock::CacheLock(const std::filesystem::path& entry, const std::function<void()>& wait) {
  constexpr mode_t of_all = 0666;  // less what the user's mask takes away
  file_ = ::open((entry.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, of_all);
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  wait();
  while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

CacheLock::~CacheLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace blocklift::pipeline
