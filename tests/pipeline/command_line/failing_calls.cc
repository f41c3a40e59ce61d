// A library that is loaded before all others (LD_PRELOAD) and makes one call of the system fail.
//
// The variables of the environment:
//   BLOCKLIFT_FAIL_CALL  open (of new files of results in preparation), write, fsync or rename: the
//                        calls that are counted, of regular files alone; memory: what asks for 64
//                        kilobytes or more
//   BLOCKLIFT_FAIL_AT    which of them, from 1
//   BLOCKLIFT_FAIL_HOW   error: that call fails, for lack of space; full: it writes half of what it
//                        is given, and it and all later calls of its kind fail (of memory: all
//                        later ones fail); kill: the process is killed before it

#ifdef _FORTIFY_SOURCE
#undef _FORTIFY_SOURCE
#endif

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> calls{0};

bool is_variable(const char* name, const char* value) {
  const char* given = std::getenv(name);
  return given != nullptr && std::strcmp(given, value) == 0;
}

/// Counts a call. @returns true if it is to fail.
bool fails(const char* call) {
  if (!is_variable("BLOCKLIFT_FAIL_CALL", call)) return false;
  const char* which = std::getenv("BLOCKLIFT_FAIL_AT");
  const long at = which == nullptr ? 0 : std::strtol(which, nullptr, 10);
  const long now = ++calls;
  if (now == at && is_variable("BLOCKLIFT_FAIL_HOW", "kill")) std::raise(SIGKILL);
  return now == at || (now > at && is_variable("BLOCKLIFT_FAIL_HOW", "full"));
}

using Main = int (*)(int, char**, char**);
Main true_main = nullptr;
// Libraries ask for memory as they are loaded, when nobody can catch what they throw.
std::atomic<bool> main_has_begun{false};

int counted_main(int count, char** arguments, char** variables) {
  main_has_begun = true;
  return true_main(count, arguments, variables);
}

/// Counts a demand for memory; small ones are always met.
bool is_refused(size_t size) {
  constexpr size_t smallest = 65536;
  if (size < smallest || !main_has_begun || !fails("memory")) return false;
  errno = ENOMEM;
  return true;
}

bool is_short() {
  const char* which = std::getenv("BLOCKLIFT_FAIL_AT");
  return is_variable("BLOCKLIFT_FAIL_HOW", "full") && which != nullptr &&
         calls == std::strtol(which, nullptr, 10);
}

bool is_regular(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

int no_space() {
  errno = ENOSPC;
  return -1;
}

bool makes_file(const char* path, int flags) {
  // HDF5 first tries whether the file is there: only its making counts.
  return (flags & O_CREAT) != 0 && (flags & O_DIRECTORY) == 0 &&
         std::strstr(path, "in-preparation") != nullptr;
}

int open_next(const char* name, const char* path, int flags, mode_t mode) {
  if (makes_file(path, flags) && fails("open")) return no_space();
  return next<int (*)(const char*, int, ...)>(name)(path, flags, mode);
}

FILE* fopen_next(const char* name, const char* path, const char* mode) {
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  if (writes && makes_file(path, O_CREAT) && fails("open")) {
    errno = ENOSPC;
    return nullptr;
  }
  return next<FILE* (*)(const char*, const char*)>(name)(path, mode);
}

ssize_t pwrite_next(const char* name, int file, const void* bytes, size_t count, off_t offset) {
  const auto write_on = next<ssize_t (*)(int, const void*, size_t, off_t)>(name);
  if (is_regular(file) && fails("write"))
    return is_short() && count > 1 ? write_on(file, bytes, count / 2, offset) : no_space();
  return write_on(file, bytes, count, offset);
}

}  // namespace

extern "C" {

#pragma GCC visibility push(default)

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_next("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return open_next("open64", path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) { return fopen_next("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return fopen_next("fopen64", path, mode); }

ssize_t write(int file, const void* bytes, size_t count) {
  const auto write_on = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (is_regular(file) && fails("write"))
    return is_short() && count > 1 ? write_on(file, bytes, count / 2) : no_space();
  return write_on(file, bytes, count);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (is_regular(file) && fails("write")) return no_space();
  return next<ssize_t (*)(int, const struct iovec*, int)>("writev")(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset) {
  return pwrite_next("pwrite", file, bytes, count, offset);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off_t offset) {
  return pwrite_next("pwrite64", file, bytes, count, offset);
}

int fsync(int file) {
  if (is_regular(file) && fails("fsync")) return no_space();
  return next<int (*)(int)>("fsync")(file);
}

// Memory. glibc gives its own functions these names as well; dlsym would ask for memory itself.

void* __libc_malloc(size_t size);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(size_t count, size_t size);   // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, size_t size);  // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(size_t step, size_t size);  // NOLINT(bugprone-reserved-identifier)

void* malloc(size_t size) { return is_refused(size) ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
  return is_refused(count * size) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  return is_refused(size) ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(size_t step, size_t size) {
  return is_refused(size) ? nullptr : __libc_memalign(step, size);
}
int posix_memalign(void** memory, size_t step, size_t size) {
  void* found = is_refused(size) ? nullptr : __libc_memalign(step, size);
  if (found == nullptr) return ENOMEM;
  *memory = found;
  return 0;
}

// What the system's own start calls, with the program's main.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
int __libc_start_main(Main main, int count, char** arguments, void (*init)(), void (*finish)(),
                      void (*finish_libraries)(), void* stack_end) {
  true_main = main;
  return next<int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*)>(
      "__libc_start_main")(counted_main, count, arguments, init, finish, finish_libraries,
                           stack_end);
}

int rename(const char* from, const char* to) {
  if (fails("rename")) return no_space();
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

#pragma GCC visibility pop
}
