#include "core/io/signals.hpp"

#include <algorithm>
#include <csignal>
#include <ctime>

namespace perifrac {
namespace {

int signal_seen = 0;

sigset_t stopping_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

sigset_t checkpoint_signal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGUSR1);
  return signals;
}

/// The one of `signals` that waits; it does no more. Not positive: none.
int take_waiting(const sigset_t& signals) {
  const timespec at_once{};
  return sigtimedwait(&signals, nullptr, &at_once);
}

}  // namespace

void hold_back_signals() {
  sigset_t signals = stopping_signals();
  sigaddset(&signals, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

int received_signal() {
  if (signal_seen == 0) signal_seen = std::max(take_waiting(stopping_signals()), 0);
  return signal_seen;
}

bool checkpoint_requested() { return take_waiting(checkpoint_signal()) > 0; }

}  // namespace perifrac
