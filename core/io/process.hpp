#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace perifrac {

/// What to start: a program, found on the path, and its arguments.
struct ProcessCommand {
  std::vector<std::string> words;
  std::filesystem::path log{};  ///< where standard errors go; empty: where ours go
  std::string input{};          ///< its standard input; empty: ours
  bool quiet = false;           ///< standard output goes nowhere, else where ours goes
  /// The process leads a group of its own: a key on the terminal does not reach it, our signals
  /// reach whatever it started too.
  bool own_group = false;
};

/// How a process ended and what it took, as the operating system says.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;            ///< that killed it; 0: none
  double cpu_time = 0.0;     ///< [s]
  double peak_memory = 0.0;  ///< [bytes]
};

/// A process that we started. It is killed with this object if it still runs, and asked to stop
/// (SIGTERM) by the system where we end without that.
class Process {
 public:
  /// Throws std::system_error where it cannot be started.
  explicit Process(const ProcessCommand& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  std::optional<ProcessEnd> poll();  ///< nothing while it runs
  ProcessEnd wait();
  void signal(int number) const;

 private:
  std::optional<ProcessEnd> collect(int options);

  bool own_group_;
  pid_t pid_ = 0;
  std::optional<ProcessEnd> end_;
};

}  // namespace perifrac
