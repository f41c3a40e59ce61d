#include "structure/large_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace blocklift::structure {

void prefer_large_pages(void* begin, std::size_t bytes) {
  // What is smaller comes from memory that is used again and again, and is not worth a call.
  constexpr std::size_t worth_it = std::size_t{8} << 20U;
  if (begin == nullptr || bytes < worth_it) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  const std::size_t whole = (bytes - before) / page * page;
  // A wish only: what the kernel says to it changes nothing.
  static_cast<void>(::madvise(static_cast<char*>(begin) + before, whole, MADV_HUGEPAGE));
}

}  // namespace blocklift::structure
