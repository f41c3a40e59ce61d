#pragma once

#include <chrono>

namespace blocklift::pipeline {

/// Wall-clock times of the stages of a run.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since the start.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace blocklift::pipeline
