#include "parallel/blas_threads.h"

#include <dlfcn.h>

#include <mutex>

namespace blocklift::parallel {
namespace {

// OpenBLAS is one BLAS of several that may be installed: its own functions are looked up, once, for
// that goes through all libraries of the process.
int blas_threads() {
  static void* const function = ::dlsym(RTLD_DEFAULT, "openblas_get_num_threads");
  return function == nullptr ? 0 : reinterpret_cast<int (*)()>(function)();
}

void set_blas_threads(int threads) {
  static void* const function = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
  if (function != nullptr) reinterpret_cast<void (*)(int)>(function)(threads);
}

/// Those that live.
struct Living {
  std::mutex counting;
  int count = 0;
  int before = 0;  ///< threads that BLAS had without them; 0 where BLAS is another library
};

Living& living() {
  static Living all;
  return all;
}

}  // namespace

OneBlasThread::OneBlasThread() {
  Living& all = living();
  const std::lock_guard lock(all.counting);
  if (all.count++ > 0) return;
  all.before = blas_threads();
  if (all.before > 1) set_blas_threads(1);
}

OneBlasThread::~OneBlasThread() {
  Living& all = living();
  const std::lock_guard lock(all.counting);
  if (--all.count == 0 && all.before > 1) set_blas_threads(all.before);
}

}  // namespace blocklift::parallel
