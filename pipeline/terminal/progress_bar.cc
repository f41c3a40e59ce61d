#include "pipeline/terminal/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {

namespace {

constexpr std::chrono::milliseconds silence{1000};
constexpr std::chrono::milliseconds refresh{100};
constexpr std::chrono::seconds between_lines{30};
constexpr int bar_width = 16;

const std::chrono::steady_clock::time_point program_start = std::chrono::steady_clock::now();

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// When a line was written last where standard error is no terminal: stages come and go faster.
std::chrono::steady_clock::time_point last_line = program_start;

std::mutex last_text_guard;
std::string last_text;

void note(std::string text) {
  const std::lock_guard lock(last_text_guard);
  last_text = std::move(text);
}

/// "45 s", "12 min".
std::string time_text(double seconds) {
  return seconds < 120 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60);
}

/// Columns of the terminal: a longer line would wrap, and wiping it would leave its beginning.
std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1U : 79U;
}

}  // namespace

std::string progress_text(const std::string& stage, double fraction, double elapsed_s,
                          double stage_s, const std::string& detail) {
  const double done = std::clamp(fraction, 0.0, 1.0);
  std::string text = fmt::format("{} {:.0f} %, {}", stage, 100 * done, time_text(elapsed_s));
  // Earlier the guess would be one of noise.
  if (done > 0.02 && done < 1 && stage_s > 2)
    text += fmt::format(", about {} left", time_text(stage_s * (1 - done) / done));
  return detail.empty() ? text : text + ", " + detail;
}

std::string last_progress() {
  const std::lock_guard lock(last_text_guard);
  return last_text;
}

ProgressBar::ProgressBar(std::string stage)
    : stage_(std::move(stage)), on_terminal_(isatty(STDERR_FILENO) == 1) {
  log_entry(stage_ + " begins");
  note(stage_);
}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\r\033[K");
  log_entry(fmt::format("{} took {:.1f} s", stage_, seconds_between(begun_, Clock::now())));
}

void ProgressBar::show(double fraction, const std::string& detail) {
  const Clock::time_point now = Clock::now();
  const std::string text = progress_text(stage_, fraction, seconds_between(program_start, now),
                                         seconds_between(begun_, now), detail);
  note(text);
  if (now - last_line >= between_lines) {
    last_line = now;
    log_entry(text);
    if (!on_terminal_ && !is_quiet()) {
      fmt::print(stderr, "{}\n", text);
      std::fflush(stderr);
    }
  }
  if (!on_terminal_ || is_quiet()) return;
  if (now - program_start < silence || (shown_ && now - last_shown_ < refresh)) return;
  last_shown_ = now;
  shown_ = true;
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * bar_width);
  const std::string line =
      fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", bar_width - filled, text);
  fmt::print(stderr, "\r\033[K{}", line.substr(0, terminal_columns()));
  std::fflush(stderr);
}

}  // namespace blocklift::pipeline
