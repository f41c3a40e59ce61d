#include "pipeline/study/run/study_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <string>
#include <system_error>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/formats/unfinished_files.h"

namespace blocklift::pipeline {

StudyLock::StudyLock(const std::filesystem::path& folder, Use use) {
  const std::filesystem::path members = folder / "members";
  std::error_code ignored;
  std::filesystem::create_directories(members, ignored);
  constexpr mode_t of_all = 0666;  // less what the user's mask takes away
  file_ = ::open((members / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, of_all);
  const int kind = use == Use::whole ? LOCK_EX : LOCK_SH;
  if (file_ < 0) return;
  if (::flock(file_, kind | LOCK_NB) == 0) {
    if (use == Use::whole) remove_unfinished_files(members);
    return;
  }
  if (errno != EWOULDBLOCK) return;
  ::close(file_);
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(folder.string()), 0, 0},
                    "another run of a study is at work in this folder",
                    {"wait for its end, or name another folder with --output"});
  throw InputError(diagnostics);
}

StudyLock::~StudyLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace blocklift::pipeline
