#include "structure/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Clock = std::chrono::steady_clock;

// Sanitizers reserve far more addresses than any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool addresses_are_limited = false;
#else
constexpr bool addresses_are_limited = true;
#endif

/// How a child's work ended: the first byte of what it sends.
enum class Ending : char { done = 'd', failed = 'f', out_of_memory = 'm' };

/// A child that waits for something takes no time of the processor: it has this many times its
/// limit by the clock, since other programs run as well.
constexpr double by_the_clock = 30;

void limit(int resource, double value) {
  rlimit limits{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limits) != 0) return;
  const auto asked = static_cast<rlim_t>(std::max(1.0, std::ceil(value)));
  limits.rlim_cur = limits.rlim_max == RLIM_INFINITY ? asked : std::min(asked, limits.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

double addresses_in_use() {
  std::ifstream file("/proc/self/statm");
  double pages = 0;
  file >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

bool send(int file, const void* data, std::size_t size) {
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(file, from, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    from += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void send_text(int file, Ending ending, const std::string& text) {
  send(file, &ending, 1);
  send(file, text.data(), text.size());
}

void work_and_send(const std::function<Packet()>& work, int file) {
  try {
    const Packet packet = work();
    const Ending done = Ending::done;
    send(file, &done, 1);
    const std::size_t size = packet.bytes().size();
    send(file, &size, sizeof size);
    send(file, packet.bytes().data(), size);
  } catch (const std::bad_alloc&) {
    send_text(file, Ending::out_of_memory, "");
  } catch (const std::exception& error) {
    send_text(file, Ending::failed, error.what());
  } catch (...) {  // a library's own kind
    send_text(file, Ending::failed, "an error without a text");
  }
}

[[noreturn]] void run_child(const std::function<Packet()>& work, const ChildLimits& limits,
                            int file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGTERM, SIGINT})
    std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  limit(RLIMIT_CORE, 1);
  allow_processor_time(limits.seconds);
  if (addresses_are_limited && limits.memory > 0)
    limit(RLIMIT_AS, addresses_in_use() + limits.memory);
  work_and_send(work, file);
  // What the parent has open and will close is left alone.
  _exit(0);
}

/// All that the child sends, or what came until the deadline; `is_late` says which.
std::vector<std::byte> receive(int file, Clock::time_point deadline, bool& is_late) {
  std::vector<std::byte> bytes;
  std::vector<std::byte> portion(1 << 16);
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    is_late = left <= 0;
    if (is_late) return bytes;
    pollfd waiting{file, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 60000))) <= 0) continue;
    const ssize_t count = ::read(file, portion.data(), portion.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.insert(bytes.end(), portion.begin(), portion.begin() + count);
  }
}

std::string way_of_death(int status, bool is_late, const ChildLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (is_late || signal == SIGXCPU)
    return "came to no end in the time that it is given and was stopped";
  if (signal == SIGKILL) return "was killed, perhaps because the machine has no more memory";
  if (signal != 0) return fmt::format("crashed ({})", strsignal(signal));
  return fmt::format("ended without a result (exit code {}, with {:.3g} GB at most)",
                     WIFEXITED(status) ? WEXITSTATUS(status) : -1, limits.memory / 1e9);
}

std::string text_of(const std::vector<std::byte>& bytes, std::size_t from) {
  std::string text(bytes.size() - from, ' ');
  if (!text.empty()) std::memcpy(text.data(), bytes.data() + from, text.size());
  return text;
}

Packet packet_of(const std::vector<std::byte>& bytes, int status, bool is_late,
                 const ChildLimits& limits) {
  constexpr std::size_t head = 1 + sizeof(std::size_t);
  const Ending ending = bytes.empty() ? Ending::done : static_cast<Ending>(bytes.front());
  if (!bytes.empty() && ending == Ending::failed) throw ModelError(text_of(bytes, 1));
  if (!bytes.empty() && ending == Ending::out_of_memory)
    throw ChildDied(fmt::format("asked for more than the {:.3g} GB of memory that it is given",
                                limits.memory / 1e9));
  std::size_t size = 0;
  if (bytes.size() >= head) std::memcpy(&size, bytes.data() + 1, sizeof size);
  if (bytes.size() < head || bytes.size() - head != size)
    throw ChildDied(way_of_death(status, is_late, limits));
  return Packet({bytes.begin() + static_cast<std::ptrdiff_t>(head), bytes.end()});
}

}  // namespace

void allow_processor_time(double seconds) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto in_seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  limit(RLIMIT_CPU, in_seconds(used.ru_utime) + in_seconds(used.ru_stime) + seconds);
}

Packet in_child_process(const std::function<Packet()>& work, const ChildLimits& limits) {
  int files[2] = {-1, -1};
  const auto refuse = [] {
    throw ModelError("a child process cannot be started: " +
                     std::generic_category().message(errno));
  };
  if (::pipe2(files, O_CLOEXEC) != 0) refuse();
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(files[0]);
    ::close(files[1]);
    refuse();
  }
  if (child == 0) run_child(work, limits, files[1]);
  ::close(files[1]);
  bool is_late = false;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(by_the_clock * limits.seconds));
  const std::vector<std::byte> bytes = receive(files[0], deadline, is_late);
  ::close(files[0]);
  if (is_late) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return packet_of(bytes, status, is_late, limits);
}

}  // namespace blocklift::structure
