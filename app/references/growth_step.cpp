#include "app/references/growth_step.hpp"

#include <cmath>
#include <vector>

namespace perifrac {

namespace {

/// The mean of `ratio` from `first` to `last`, each row standing for the time since the one before.
std::optional<double> mean_over(std::span<const double> times, std::span<const double> ratio,
                                double first, double last) {
  double sum = 0.0, time = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (times[k] < first || times[k] > last) continue;
    sum += (times[k] - times[k - 1]) * ratio[k];
    time += times[k] - times[k - 1];
  }
  if (!(time > 0.0)) return std::nullopt;
  return sum / time;
}

}  // namespace

decltype(Reference::Figure::computed) worst_mean_of_growth(Reference::OfTime step, double end,
                                                           Reference::OfTime exact) {
  return
      [=](std::span<const double> times, std::span<const double> values) -> std::optional<double> {
        std::vector<double> ratio(times.size());
        for (std::size_t k = 0; k < times.size(); ++k) ratio[k] = values[k] / exact(times[k]);
        std::optional<double> worst;
        for (const double t : times) {
          const double half = 0.5 * step(t);
          if (!(t - half >= 0.5 * end && t + half <= end)) continue;  // NaN at t = 0
          const std::optional<double> mean = mean_over(times, ratio, t - half, t + half);
          if (!mean) continue;
          if (!worst || std::abs(*mean - 1.0) > std::abs(*worst - 1.0)) worst = mean;
        }
        return worst;
      };
}

void compare_growth(Reference& reference, const OfGrowth& compared, const Reference::OfTime& step,
                    double end) {
  const auto& [quantity, place, unit, computed, exact] = compared;
  reference.add(
      Reference::Error{quantity + "_error", [computed = computed, exact = exact](double t) {
                         return std::abs(computed() / exact(t) - 1.0);
                       }});
  const std::size_t history =
      reference.add(Reference::History{quantity + " at " + place, unit, computed, exact});
  reference.add(Reference::Figure{.name = quantity + " over the exact, mean of a step",
                                  .unit = "",
                                  .exact = 1.0,
                                  .scale = 1.0,
                                  .history = history,
                                  .computed = worst_mean_of_growth(step, end, exact)});
}

}  // namespace perifrac
