#include "pipeline/processes/lost_processes.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {
namespace {

using structure::ProcessGroup;

// A large machine may need longer to start processes than a running one is silent.
constexpr double longest_wait = 5;

/// Waits beside MPI until the processes have joined, and ends this one if they do not.
class JoinWatch {
 public:
  JoinWatch() : thread_([this](const std::stop_token& joined) { watch(joined); }) {}

 private:
  void watch(const std::stop_token& joined) {
    const double silence = silence_of_lost();
    if (is_joined_within(silence, joined)) return;
    const bool leads = ProcessGroup::place_among_launched() == 0;
    if (leads)
      say_warning(fmt::format(
          "{} processes were started, and not all of them have joined for {:g} s: one may be lost",
          ProcessGroup::launched(), silence));
    std::fflush(stdout);
    if (is_joined_within((longest_wait - 1) * silence, joined)) return;
    if (leads) say_end(longest_wait * silence);
    ::_exit(exit_code::run_failed);
  }
  bool is_joined_within(double seconds, const std::stop_token& joined) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, joined, std::chrono::duration<double>(seconds), [] { return false; });
    return joined.stop_requested();
  }
  static void say_end(double seconds) {
    const std::string message = fmt::format(
        "the processes have not joined for {:g} s, so that one of them was lost before it began; "
        "start the command again",
        seconds);
    fmt::print(stderr, "blocklift: error: {}\n", message);
    log_error(message);
    std::fflush(stderr);
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::jthread thread_;  ///< the last: it uses the others
};

}  // namespace

double silence_of_lost() {
  constexpr double usual = 60;
  const char* text = std::getenv("BLOCKLIFT_LOST_AFTER");
  const double seconds = text ? std::atof(text) : 0;
  return seconds > 0 ? seconds : usual;
}

const ProcessGroup& join_launched_processes() {
  const JoinWatch until_all_have_joined;
  return ProcessGroup::of_this_run();
}

}  // namespace blocklift::pipeline
