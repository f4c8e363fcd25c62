#include "core/io/signals.hpp"

#include <csignal>

namespace perifrac {
namespace {

volatile std::sig_atomic_t first_signal = 0;

extern "C" void remember_signal(int signal) {
  if (first_signal == 0) {
    first_signal = signal;
  }
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESTART;  // a write that is under way goes on
  // Neither interrupts the other: the first one counts.
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int received_signal() { return first_signal; }

}  // namespace perifrac
