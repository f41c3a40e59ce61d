#include "pipeline/command_line/held_signals.h"

namespace blocklift::pipeline {

namespace {

volatile std::sig_atomic_t received = 0;

void keep(int signal) { received = signal; }

}  // namespace

HeldSignals::HeldSignals() {
  received = 0;
  struct sigaction action {};
  action.sa_handler = keep;
  action.sa_flags = SA_RESTART;
  for (int i = 0; i < 3; ++i) {
    sigaction(held[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(held[i], &action, nullptr);
  }
}

HeldSignals::~HeldSignals() {
  for (int i = 0; i < 3; ++i) sigaction(held[i], &before_[i], nullptr);
  if (received != 0) std::raise(received);
}

}  // namespace blocklift::pipeline
