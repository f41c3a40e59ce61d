#include "pipeline/formats/read_apart.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <system_error>

#include "structure/child_process.h"
#include "structure/error.h"

namespace blocklift::pipeline {

namespace {

structure::ChildLimits limits_for(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  const double bytes = error ? 0 : static_cast<double>(size);
  // Far more than a sound file takes: HDF5 reads hundreds of megabytes a second, and what was
  // compressed becomes ten times as much at most.
  return {2 + bytes / 10e6, 1e9 + 20 * bytes};
}

/// A text that a child process leaves to its parent, however it ends.
class SharedText {
 public:
  SharedText()
      : place_(mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {}
  ~SharedText() {
    if (place_ != MAP_FAILED) munmap(place_, size);
  }
  SharedText(const SharedText&) = delete;
  SharedText& operator=(const SharedText&) = delete;

  void set(const std::string& text) {
    if (place_ == MAP_FAILED) return;
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(place_, text.data(), length);
    static_cast<char*>(place_)[length] = '\0';
  }
  std::string get() const {
    return place_ == MAP_FAILED ? std::string() : static_cast<const char*>(place_);
  }

 private:
  static constexpr std::size_t size = 4096;
  void* place_;  ///< zeros at first
};

}  // namespace

std::optional<std::string> death_of_reading(const std::filesystem::path& file,
                                            const std::function<void()>& read) {
  try {
    structure::in_child_process(
        [&] {
          read();
          return structure::Packet();
        },
        limits_for(file));
  } catch (const structure::ChildDied& death) {
    return death.what();
  } catch (const structure::ModelError&) {
    // It is said again, in its own kind, where the file is read.
  }
  return std::nullopt;
}

std::vector<std::string> complaints_of_reading(
    const std::filesystem::path& file,
    const std::function<std::vector<std::string>(const PlaceOfReading&)>& read) {
  SharedText place;
  try {
    structure::Packet packet = structure::in_child_process(
        [&] {
          structure::Packet sent;
          const std::vector<std::string> complaints =
              read([&](const std::string& next) { place.set(next); });
          sent.put(complaints.size());
          for (const std::string& complaint : complaints) sent.put(complaint);
          return sent;
        },
        limits_for(file));
    std::size_t count = 0;
    packet.take(count);
    std::vector<std::string> complaints(count);
    for (std::string& complaint : complaints) packet.take(complaint);
    return complaints;
  } catch (const structure::ChildDied& death) {
    const std::string what = place.get().empty() ? "it" : "\"" + place.get() + "\" of it";
    return {"is damaged: reading " + what + " " + death.what()};
  } catch (const structure::ModelError& error) {
    return {error.what()};
  }
}

}  // namespace blocklift::pipeline
