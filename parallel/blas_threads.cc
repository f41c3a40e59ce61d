#include "parallel/blas_threads.h"

#include <dlfcn.h>

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

}  // namespace

OneBlasThread::OneBlasThread() : before_(blas_threads()) {
  if (before_ > 1) set_blas_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (before_ > 1) set_blas_threads(before_);
}

}  // namespace blocklift::parallel
