#include "pipeline/formats/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace blocklift::pipeline {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const auto fail = [&](int code) {
    throw std::runtime_error(path.string() +
                             ": cannot read the file: " + std::generic_category().message(code));
  };
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(errno);
  struct stat status {};
  int code = ::fstat(file, &status) == 0 ? 0 : errno;
  size_ = static_cast<std::size_t>(status.st_size);
  // Nothing cannot be mapped.
  if (code == 0 && size_ > 0) {
    begin_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    if (begin_ == MAP_FAILED) code = errno;
  }
  ::close(file);
  if (code != 0) fail(code);
}

MappedFile::~MappedFile() {
  if (size_ > 0) ::munmap(begin_, size_);
}

}  // namespace blocklift::pipeline
