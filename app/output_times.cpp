#include "app/output_times.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perifrac {

std::vector<double> read_output_times(const Section& output, double end) {
  std::vector<double> times;
  if (output.has("times")) times = output.numbers("times");
  for (const double t : times) {
    if (t > end) {
      output.fail("times", fmt::format("{:g} s lies beyond the end", t),
                  fmt::format("times up to time.end, {:g} s", end));
    }
  }
  if (output.has("interval")) {
    const double interval = output.number("interval");
    constexpr double most = 1e6;
    if (end / interval > most) {
      output.fail("interval", fmt::format("asks for {:.0f} frames", end / interval),
                  fmt::format("at most {:.0f}", most));
    }
    // By multiplication, so that no rounding adds up.
    for (long n = 1; n * interval < end * (1.0 - 1e-9); ++n) times.push_back(n * interval);
  }
  times.push_back(end);
  std::ranges::sort(times);
  times.erase(times.begin(), std::ranges::upper_bound(times, 0.0));
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace perifrac
