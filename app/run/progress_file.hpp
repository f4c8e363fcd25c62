#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>

#include <nlohmann/json_fwd.hpp>

#include "core/io/progress.hpp"

namespace perifrac {

/// DIR/progress.json, for whoever watches a run: how far it is, who runs it, and what summary.json
/// would say now, once a second of wall time or less often. Nothing is computed for it that history
/// does not ask for too, and a run does not care whether it can be written. Gone when the run ends.
class ProgressFile {
 public:
  using State = std::function<nlohmann::json()>;

  /// The simulation goes from time `begin` to `end` [s]; `state` gives the summary as it stands.
  ProgressFile(std::filesystem::path folder, double begin, double end, State state);
  ~ProgressFile();
  ProgressFile(const ProgressFile&) = delete;
  ProgressFile& operator=(const ProgressFile&) = delete;

  /// Cheap enough to be called after every window.
  void update(double time, std::int64_t step);

 private:
  std::filesystem::path file_;
  double begin_;
  double end_;
  State state_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_;
  TimeLeft time_left_;
};

}  // namespace perifrac
