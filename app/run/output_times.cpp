#include "app/run/output_times.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace perifrac {

namespace {

/// Times that differ by rounding only are one: the window between them would be a sliver.
constexpr double time_rounding = 1e-9;

bool has_near(const std::vector<double>& times, double t) {
  return std::ranges::any_of(times, [=](double s) { return std::abs(s - t) <= time_rounding * t; });
}

void add_multiples(const Section& output, double end, std::vector<double>& times) {
  const double interval = output.number("interval");
  constexpr double most = 1e6;
  if (end / interval > most) {
    output.fail("interval", fmt::format("asks for {:.0f} frames", end / interval),
                fmt::format("at most {:.0f}", most));
  }
  const std::vector<double> written = times;
  // By multiplication, so that no rounding adds up.
  for (double n = 1.0; n * interval <= end * (1.0 + time_rounding); ++n) {
    if (!has_near(written, n * interval)) times.push_back(n * interval);
  }
}

}  // namespace

std::vector<double> read_output_times(const Section& output, double scene_end,
                                      std::optional<double> until) {
  std::vector<double> times;
  if (output.has("times")) times = output.numbers("times");
  for (const double t : times) {
    if (t > scene_end) {
      output.fail("times", fmt::format("{:g} s lies beyond the end", t),
                  fmt::format("times up to time.end, {:g} s", scene_end));
    }
  }
  const double end = until.value_or(scene_end);
  if (!has_near(times, scene_end)) times.push_back(scene_end);
  if (output.has("interval")) add_multiples(output, end, times);
  if (!has_near(times, end)) times.push_back(end);
  std::erase_if(times, [=](double t) { return t <= 0.0 || t > end * (1.0 + time_rounding); });
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace perifrac
