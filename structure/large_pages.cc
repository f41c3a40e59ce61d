#include "structure/large_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include "parallel/threads.h"

namespace blocklift::structure {

namespace {

/// The whole pages of some memory.
struct WholePages {
  char* begin;
  std::size_t bytes;
};

WholePages whole_pages(void* begin, std::size_t bytes) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  return {static_cast<char*>(begin) + before, (bytes - before) / page * page};
}

}  // namespace

// Of both, what the kernel says to it changes nothing.

void prefer_large_pages(void* begin, std::size_t bytes) {
  // What is smaller comes from memory that is used again and again, and is not worth a call.
  constexpr std::size_t worth_it = std::size_t{8} << 20U;
  if (begin == nullptr || bytes < worth_it) return;
  const WholePages pages = whole_pages(begin, bytes);
  static_cast<void>(::madvise(pages.begin, pages.bytes, MADV_HUGEPAGE));
}

void take_pages(void* begin, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t worth_it = std::size_t{64} << 20U, together = std::size_t{16} << 20U;
  if (begin == nullptr || bytes < worth_it) return;
  const WholePages pages = whole_pages(begin, bytes);
  parallel::for_each(static_cast<int>((pages.bytes + together - 1) / together), 0, [&](int piece) {
    const std::size_t first = together * static_cast<std::size_t>(piece);
    static_cast<void>(::madvise(pages.begin + first, std::min(together, pages.bytes - first),
                                MADV_POPULATE_WRITE));
  });
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

}  // namespace blocklift::structure
