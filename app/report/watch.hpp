#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/io/process.hpp"

namespace perifrac {

/// What `perifrac watch` was asked for.
struct WatchRequest {
  std::string folder;
  int port = 0;  ///< of 127.0.0.1; 0: one that is free
};

/// Serves the page on which a run's folder can be watched, on this machine alone, until a signal
/// ends it; returns the exit code.
int watch(const WatchRequest& request);

/// The same beside a run, for as long as this object lives and an open page needs to see the end.
/// The address goes to standard error. Where Python is missing the log says so and nobody watches.
class Watcher {
 public:
  explicit Watcher(const std::filesystem::path& folder);
  ~Watcher();
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;

 private:
  std::optional<Process> server_;
};

}  // namespace perifrac
