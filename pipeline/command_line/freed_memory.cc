#include "pipeline/command_line/freed_memory.h"

#include <malloc.h>

namespace blocklift::pipeline {

void return_freed_memory() {
#if defined(__GLIBC__)
  constexpr int megabyte = 1 << 20;
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_TRIM_THRESHOLD, 512 * megabyte);
#endif
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  ::mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

void return_what_is_free() {
#if defined(__GLIBC__)
  ::malloc_trim(0);
#endif
}

}  // namespace blocklift::pipeline
