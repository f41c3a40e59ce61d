#include "structure/limits.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>

namespace blocklift::structure {

namespace {

std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};

/// Pages that the process holds in memory, bytes; 0 where it cannot be told.
double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  if (!(file >> size >> resident)) return 0;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

// OpenBLAS is one BLAS of several that may be installed: its own functions are looked up.
int blas_threads() {
  void* function = ::dlsym(RTLD_DEFAULT, "openblas_get_num_threads");
  return function == nullptr ? 0 : reinterpret_cast<int (*)()>(function)();
}

void set_blas_threads(int threads) {
  if (void* function = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(function)(threads);
}

}  // namespace

OneBlasThread::OneBlasThread() : before_(blas_threads()) {
  if (before_ > 1) set_blas_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (before_ > 1) set_blas_threads(before_);
}

void limit_memory(double bytes) { memory_limit = bytes; }

double memory_within_limit() {
  if (std::isinf(memory_limit)) return memory_limit;
  return std::max(0.0, memory_limit - resident_bytes());
}

}  // namespace blocklift::structure
