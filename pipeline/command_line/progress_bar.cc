#include "pipeline/command_line/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

constexpr std::chrono::milliseconds silence{1000};
constexpr std::chrono::milliseconds refresh{100};
constexpr int bar_width = 30;

const std::chrono::steady_clock::time_point program_start = std::chrono::steady_clock::now();

/// Columns of the terminal: a longer line would wrap, and wiping it would leave its beginning.
std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1U : 79U;
}

}  // namespace

ProgressBar::ProgressBar(std::string stage)
    : stage_(std::move(stage)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double fraction, const std::string& detail) {
  if (!on_terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now - program_start < silence || (shown_ && now - last_shown_ < refresh)) return;
  last_shown_ = now;
  shown_ = true;
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * bar_width);
  const std::string line = fmt::format("{} [{:#<{}}{:.<{}}] {:3.0f} % {}", stage_, "", filled, "",
                                       bar_width - filled, 100 * done, detail);
  fmt::print(stderr, "\r\033[K{}", line.substr(0, terminal_columns()));
  std::fflush(stderr);
}

}  // namespace blocklift::pipeline
