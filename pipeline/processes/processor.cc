#include "pipeline/processes/processor.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "parallel/threads.h"

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

/// What --threads asks for, as text; empty without it. Whether it is a number is told later.
std::string threads_asked(int count, char** arguments) {
  constexpr std::string_view option = "--threads";
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == option && i + 1 < count) return arguments[i + 1];
    if (argument.starts_with(option) && argument.substr(option.size()).starts_with('='))
      return std::string(argument.substr(option.size() + 1));
  }
  return {};
}

/// Sets the variables that our own loops and BLAS follow. @returns true if one changed.
bool limit_threads(int count, char** arguments) {
  const std::string asked = threads_asked(count, arguments);
  // What is no count is refused when the options are read, and must not end a library's start.
  if (asked.empty() || asked.size() > 4 || asked.front() == '0' ||
      asked.find_first_not_of("0123456789") != std::string::npos)
    return false;
  bool changed = false;
  for (const char* variable : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) {
    const char* present = std::getenv(variable);
    if (present != nullptr && present == asked) continue;
    changed = ::setenv(variable, asked.c_str(), 1) == 0 || changed;
  }
  return changed;
}

}  // namespace

void use_all_of_the_processor(int count, char** arguments) {
  const std::string_view command = count > 1 ? arguments[1] : "";
  bool changed = limit_threads(count, arguments);
  if (command != "assess" && command != "stress") {
    if (changed) ::execv("/proc/self/exe", arguments);
    return;
  }
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

std::string describe_arithmetic() {
  void* name = ::dlsym(RTLD_DEFAULT, "openblas_get_corename");
  void* threads = ::dlsym(RTLD_DEFAULT, "openblas_get_num_threads");
  return fmt::format(
      "{}, {} and {} threads", name ? reinterpret_cast<char* (*)()>(name)() : "other kernels",
      threads ? reinterpret_cast<int (*)()>(threads)() : 0, parallel::usable_threads());
}

}  // namespace blocklift::pipeline
