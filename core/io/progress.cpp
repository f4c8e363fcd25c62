#include "core/io/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/ranks.hpp"

namespace perifrac {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

bool line_is_shown = false;

/// A line that wraps cannot be taken away again.
std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void show_line(std::string line) {
  line.resize(std::min(line.size(), terminal_width() - 1));
  fmt::print(stderr, "\r{}\x1b[K", line);
  std::fflush(stderr);
  line_is_shown = true;
}

std::string wall_time(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::lround(seconds));
  if (whole < 60) {
    return fmt::format("{} s", whole);
  }
  if (whole < 3600) {
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  }
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

void TimeLeft::record(double wall, double simulated) {
  constexpr double memory = 10.0;  // [s] of wall time
  if (wall_ && wall <= *wall_) {
    return;
  }
  if (wall_) {
    const double keep = std::exp(-(wall - *wall_) / memory);
    speed_ = keep * speed_ + (1.0 - keep) * (simulated - simulated_) / (wall - *wall_);
    weight_ = keep * weight_ + (1.0 - keep);
  }
  wall_ = wall;
  simulated_ = simulated;
}

std::optional<double> TimeLeft::until(double simulated_end) const {
  if (speed_ <= 0.0) {
    return {};
  }
  return (simulated_end - simulated_) * weight_ / speed_;
}

Progress::Progress(double begin, double end)
    : begin_(begin),
      end_(end),
      shown_(isatty(STDERR_FILENO) != 0),
      start_(steady_clock::now()),
      next_(start_) {}

Progress::~Progress() { clear_progress_line(); }

void Progress::update(double time, std::int64_t windows, const std::function<std::string()>& more) {
  const auto now = steady_clock::now();
  if (!ranks::first_says(shown_ && now >= next_)) return;
  const std::string also = more ? more() : "";
  if (!shown_) return;
  next_ = now + std::chrono::milliseconds(200);
  time_left_.record(duration<double>(now - start_).count(), time);
  const double part = end_ > begin_ ? (time - begin_) / (end_ - begin_) : 1.0;
  std::string line = fmt::format("{:3.0f} %   t = {:.4g} s of {:.4g} s   {} windows",
                                 std::floor(100.0 * part), time, end_, windows);
  line += also;
  if (const auto left = time_left_.until(end_)) {
    line += fmt::format("   {} left", wall_time(*left));
  }
  show_line(std::move(line));
}

void clear_progress_line() {
  if (line_is_shown) {
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    line_is_shown = false;
  }
}

}  // namespace perifrac
