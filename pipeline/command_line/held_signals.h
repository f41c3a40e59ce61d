#pragma once

#include <csignal>

#include "pipeline/command_line/limits.h"

namespace blocklift::pipeline {

/// Holds back the signals that would end the program (Ctrl-C, hang-up, termination) while it lives,
/// so that a set of files is written whole, and the limit of time with them; at its end the one
/// that came takes its usual effect. Signals that the program ignores stay ignored. One object at a
/// time.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  static constexpr int held[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3];
  NoEndOfTime no_end_of_time_;
};

}  // namespace blocklift::pipeline
