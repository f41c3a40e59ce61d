#pragma once

#include <chrono>
#include <string>

namespace blocklift::pipeline {

/// One line on a terminal that shows how far a stage of the run has come. It appears once the
/// program has run for a second and is wiped when the stage ends; it is cut to the terminal's
/// width, and where standard error is no terminal it never shows.
class ProgressBar {
 public:
  explicit ProgressBar(std::string stage);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction done, 0 to 1; `detail` stands behind the bar.
  void show(double fraction, const std::string& detail = {});

 private:
  using Clock = std::chrono::steady_clock;
  std::string stage_;
  Clock::time_point last_shown_;
  bool on_terminal_ = false;
  bool shown_ = false;
};

}  // namespace blocklift::pipeline
