#include "tests/dynamics/allocation_counter.h"

#include <atomic>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define BLOCKLIFT_COUNTS_ALLOCATIONS
#endif

namespace {
std::atomic<long> count{0};
}

#ifdef BLOCKLIFT_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
}
#endif

namespace blocklift::test {

bool counts_allocations() {
#ifdef BLOCKLIFT_COUNTS_ALLOCATIONS
  return true;
#else
  return false;
#endif
}

long allocations() { return count; }

}  // namespace blocklift::test
