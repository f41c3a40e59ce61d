#include "pipeline/command_line/processor.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace blocklift::pipeline {

namespace {

constexpr const char* kernels = "OPENBLAS_CORETYPE";
constexpr const char* tunables = "GLIBC_TUNABLES";
constexpr const char* patience = "OPENBLAS_THREAD_TIMEOUT";

// Kernels for AVX2 only, on a processor that has what Skylake's server kernels need.
bool runs_below_its_kernels() {
#if defined(__x86_64__) && defined(__GNUC__)
  // OpenBLAS is one BLAS of several that may be installed: its own functions are looked up.
  void* name = ::dlsym(RTLD_DEFAULT, "openblas_get_corename");
  if (name == nullptr) return false;
  const std::string_view chosen = reinterpret_cast<char* (*)()>(name)();
  return (chosen == "Haswell" || chosen == "Zen") && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq");
#else
  return false;
#endif
}

}  // namespace

void use_all_of_the_processor(int count, char** arguments) {
  const std::string_view command = count > 1 ? arguments[1] : "";
  if (command != "assess" && command != "stress") return;
  bool changed = false;
  if (std::getenv(patience) == nullptr) changed = ::setenv(patience, "18", 0) == 0;
  if (std::getenv(kernels) == nullptr && runs_below_its_kernels())
    changed = ::setenv(kernels, "SKYLAKEX", 0) == 0 || changed;
#if defined(__GLIBC__)
  if (std::getenv(tunables) == nullptr)
    changed = ::setenv(tunables, "glibc.malloc.hugetlb=1", 0) == 0 || changed;
#endif
  // All are set from now on, so that this happens once. Where it fails the program runs as it is.
  if (changed) ::execv("/proc/self/exe", arguments);
}

}  // namespace blocklift::pipeline
