#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace perifrac {

/// Guesses the wall time left from the speed in simulated time, smoothed over the last seconds:
/// windows grow and shrink, so the mean over the whole run would mislead.
class TimeLeft {
 public:
  /// `wall` and `simulated` are times [s] since any moment; neither ever goes back.
  void record(double wall, double simulated);

  /// Wall time [s] until `simulated_end`, counted from the last record; nothing before the second.
  std::optional<double> until(double simulated_end) const;

 private:
  std::optional<double> wall_;
  double simulated_ = 0.0;
  double speed_ = 0.0;   ///< simulated seconds a second of wall time
  double weight_ = 0.0;  ///< of what went into speed_; tends to 1
};

/// A line on the terminal: percentage, simulated time, windows, what else there is to say, time
/// left. Shown only where standard error is a terminal, at most five times a second, and taken away
/// at the end.
class Progress {
 public:
  /// The simulation goes from time `begin` to `end` [s].
  Progress(double begin, double end);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough to be called after every window; `more` is asked only where a line is shown.
  void update(double time, std::int64_t windows, const std::function<std::string()>& more = {});

 private:
  double begin_;
  double end_;
  bool shown_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_;
  TimeLeft time_left_;
};

/// Takes the progress line away, so that another line can be written; the next update brings it
/// back.
void clear_progress_line();

}  // namespace perifrac
