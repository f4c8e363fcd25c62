#include "core/io/signals.hpp"

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

}  // namespace

void hold_back_signals() {
  const sigset_t signals = stopping_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

int received_signal() {
  const sigset_t signals = stopping_signals();
  const timespec at_once{};
  if (signal_seen == 0) {
    const int signal = sigtimedwait(&signals, nullptr, &at_once);
    if (signal > 0) signal_seen = signal;
  }
  return signal_seen;
}

}  // namespace perifrac
