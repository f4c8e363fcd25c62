#include "app/references/growth_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/time/schedule.hpp"

namespace perifrac {

decltype(Reference::Figure::computed) worst_mean_of_growth(Reference::OfTime step, double end,
                                                           Reference::OfTime exact) {
  return
      [=](std::span<const double> times, std::span<const double> values) -> std::optional<double> {
        // Linear between rows.
        std::vector<double> known, ratio;
        for (std::size_t k = 0; k < times.size(); ++k) {
          if (!(times[k] > 0.0)) continue;
          known.push_back(times[k]);
          ratio.push_back(values[k] / exact(times[k]));
        }
        if (known.empty()) return std::nullopt;
        const Schedule over_exact = Schedule::table(known, ratio);
        std::optional<double> worst;
        for (const double t : known) {
          const double first = t - 0.5 * step(t), last = t + 0.5 * step(t);
          const bool fits = first >= std::max(0.5 * end, known.front()) && last <= known.back();
          if (!fits) continue;  // a step of NaN does not
          const double mean = over_exact.integral(first, last) / (last - first);
          if (!worst || std::abs(mean - 1.0) > std::abs(*worst - 1.0)) worst = mean;
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
