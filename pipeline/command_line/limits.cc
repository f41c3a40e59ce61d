#include "pipeline/command_line/limits.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "dynamics/marine/panels/rankine_problem.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "structure/limits.h"

namespace blocklift::pipeline {

namespace {

/// Held while results are moved into place.
std::mutex& end_of_time() {
  static std::mutex guard;
  return guard;
}

/// Ends the process when the time is over, whatever the other threads are doing then.
void end_after(double seconds) {
  std::thread([seconds] {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    const std::lock_guard no_results_in_motion(end_of_time());
    const std::string standing = last_progress();
    const std::string message =
        fmt::format("stopped after {:g} s, the limit of --time; {}", seconds,
                    standing.empty() ? "the input was being read" : "it stood at: " + standing);
    fmt::print(stderr, "{}blocklift: error: {}\n", ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "",
               message);
    log_error(message);
    std::fflush(stderr);
    ::_exit(exit_code::run_failed);
  }).detach();
}

}  // namespace

void add_limits(CLI::App& command, bool with_memory) {
  command.add_option_function<double>("--time", end_after, "end the run after this time, s")
      ->check(CLI::PositiveNumber);
  // Taken from the arguments before anything starts a thread (use_all_of_the_processor).
  command
      .add_option_function<int>(
          "--threads", [](int) {},
          "threads that are used (as many as the machine has if not given)")
      ->check(CLI::Range(1, 4096));
  if (!with_memory) return;
  command
      .add_option_function<double>(
          "--memory",
          [](double gigabytes) {
            structure::limit_memory(1e9 * gigabytes);
            dynamics::limit_usable_memory(1e9 * gigabytes);
          },
          "memory that may be used, GB (what the machine has if not given)")
      ->check(CLI::PositiveNumber);
}

NoEndOfTime::NoEndOfTime() { end_of_time().lock(); }
NoEndOfTime::~NoEndOfTime() { end_of_time().unlock(); }

}  // namespace blocklift::pipeline
