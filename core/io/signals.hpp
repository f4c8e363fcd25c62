#pragma once

namespace perifrac {

/// From now on SIGINT and SIGTERM do not end the program but are remembered; nothing else happens
/// in the handler, so signals may come at any moment and as often as they like. The run looks at
/// `received_signal` between windows, writes its checkpoint and ends.
void install_signal_handlers();

/// The first signal that came, 0 if none did.
int received_signal();

/// What a program that a signal has stopped exits with: 130 for SIGINT, 143 for SIGTERM.
constexpr int exit_code_of(int signal) { return 128 + signal; }

}  // namespace perifrac
