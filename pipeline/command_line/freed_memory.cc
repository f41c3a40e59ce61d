#include "pipeline/command_line/freed_memory.h"

#include <malloc.h>

namespace blocklift::pipeline {

void return_freed_memory() {
#if defined(__GLIBC__)
  constexpr int megabyte = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 32 * megabyte);  // the largest that glibc takes
  ::mallopt(M_MMAP_MAX, 65536);                // as glibc begins with
  ::mallopt(M_TRIM_THRESHOLD, 256 * megabyte);
#endif
}

}  // namespace blocklift::pipeline
