#pragma once

namespace perifrac {

/// The whole program: reads the command line, does what it says, turns errors into one line on
/// standard error, and returns the exit code: 0 done, 1 failure, 2 usage or scene, 130 or 143
/// stopped by a signal.
int run_command_line(int argc, char** argv);

}  // namespace perifrac
