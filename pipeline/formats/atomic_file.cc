#include "pipeline/formats/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "pipeline/formats/unfinished_files.h"

namespace blocklift::pipeline {
namespace {

constexpr const char* unfinished = ".part-";  // between a file's name and the writer's number

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int code) {
  throw std::runtime_error(path.string() + ": " + what + ": " +
                           std::generic_category().message(code));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  if (std::filesystem::is_directory(path_)) fail(path_, "cannot write a file here", EISDIR);
  const std::filesystem::path folder = path_.parent_path();
  if (!folder.empty()) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(folder, "cannot make the folder", error.value());
  }
  temporary_path_ =
      folder / ("." + path_.filename().string() + unfinished + std::to_string(::getpid()));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_path_, ignored);
}

void AtomicFile::commit() {
  const int file = ::open(temporary_path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path_, "cannot write the file", errno);
  // A full disk may show itself only here.
  const int flushed = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (flushed != 0) fail(path_, "cannot write the file", flushed);
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error) fail(path_, "cannot move the finished file into place", error.value());
  committed_ = true;
}

void AtomicFile::write(std::string_view content) const {
  errno = 0;
  std::ofstream stream(temporary_path_, std::ios::binary | std::ios::trunc);
  if (!stream) fail(path_, "cannot write the file", errno);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) fail(path_, "cannot write the file", errno == 0 ? EIO : errno);
}

void remove_unfinished_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.find(unfinished) != std::string::npos)
      left.push_back(entry.path());
  }
  for (const std::filesystem::path& file : left) std::filesystem::remove(file, ignored);
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) fail(path, "cannot read the file", EISDIR);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "cannot read the file", errno == 0 ? EIO : errno);
  // At once where the size is known; what has none, or grows, is read on to its end.
  std::error_code without_size;
  const std::uintmax_t size = std::filesystem::file_size(path, without_size);
  std::string content;
  if (!without_size && size > 0) {
    content.resize(size);
    stream.read(content.data(), static_cast<std::streamsize>(size));
    content.resize(stream.gcount());
  }
  if (stream)
    content.append(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  if (stream.bad()) fail(path, "cannot read the file", errno == 0 ? EIO : errno);
  return content;
}

}  // namespace blocklift::pipeline
