#include "pipeline/command_line/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

constexpr std::chrono::milliseconds silence{2000};
constexpr std::chrono::milliseconds refresh{100};
constexpr int bar_width = 30;

}  // namespace

ProgressBar::ProgressBar(std::string stage)
    : stage_(std::move(stage)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double fraction, const std::string& detail) {
  if (!on_terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now - start_ < silence || now - last_shown_ < refresh) return;
  last_shown_ = now;
  shown_ = true;
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * bar_width);
  fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} % {}", stage_, "", filled, "",
             bar_width - filled, 100 * done, detail);
  std::fflush(stderr);
}

}  // namespace blocklift::pipeline
