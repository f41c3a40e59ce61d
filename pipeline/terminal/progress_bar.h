#pragma once

#include <chrono>
#include <string>

namespace blocklift::pipeline {

/// How far a stage of a run has come, as text: "solving 40 %, 61 s, about 30 s left", with `detail`
/// behind it.
///
/// @param elapsed_s since the program began
/// @param stage_s since the stage began, from which the rest of the stage is told
std::string progress_text(const std::string& stage, double fraction, double elapsed_s,
                          double stage_s, const std::string& detail);

/// What the last bar was told to show, as progress_text; empty before the first. Any thread may
/// ask.
std::string last_progress();

/// One line on a terminal that shows how far a stage of the run has come. It appears once the
/// program has run for a second and is wiped when the stage ends; it is cut to the terminal's
/// width. Where standard error is no terminal, a line is written every half minute. Quiet runs show
/// nothing. The log (run_log.h) holds when each stage began and what it took.
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
  Clock::time_point begun_ = Clock::now();
  Clock::time_point last_shown_;
  bool on_terminal_ = false;
  bool shown_ = false;
};

}  // namespace blocklift::pipeline
