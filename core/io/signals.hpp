#pragma once

namespace perifrac {

/// From now on SIGINT and SIGTERM do not end the program: they wait until `received_signal` looks
/// for them, between windows; the run then writes its checkpoint and ends. They are blocked rather
/// than handled because METIS, under CHOLMOD, puts a handler of its own in place of ours, leaves
/// its ordering by it, and puts ours back so that it serves once only. To be called before there
/// are other threads, which inherit it, as programs do that this one starts (Process undoes it).
void hold_back_signals();

/// As for stopping signals, SIGUSR1 waits until `checkpoint_requested` looks for it: a wish for a
/// checkpoint, after which the run goes on.
bool checkpoint_requested();

/// The first signal that was seen, 0 if none came. Of two that came since the last look, SIGINT.
int received_signal();

/// What a program that a signal has stopped exits with: 130 for SIGINT, 143 for SIGTERM.
constexpr int exit_code_of(int signal) { return 128 + signal; }

}  // namespace perifrac
