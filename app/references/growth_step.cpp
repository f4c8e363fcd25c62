#include "app/references/growth_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace perifrac {

namespace {

/// Computed over exact from one row of a history to the next, linear between them.
struct Stretch {
  double begin, end;   // [s]
  double first, last;  // ratio at begin and end

  double at(double t) const { return first + (t - begin) / (end - begin) * (last - first); }

  /// The integral over what lies between these times [s].
  double integral(double from, double to) const {
    from = std::max(from, begin);
    to = std::min(to, end);
    return to > from ? 0.5 * (at(from) + at(to)) * (to - from) : 0.0;
  }
};

}  // namespace

decltype(Reference::Figure::computed) worst_mean_of_growth(Reference::OfTime step, double end,
                                                           Reference::OfTime exact,
                                                           BetweenRows between) {
  return
      [=](std::span<const double> times, std::span<const double> values) -> std::optional<double> {
        std::vector<Stretch> history;
        for (std::size_t k = 1; k < times.size(); ++k) {
          if (!(times[k - 1] > 0.0 && times[k] > times[k - 1])) continue;
          const double last = values[between == BetweenRows::held ? k - 1 : k];
          history.push_back({times[k - 1], times[k], values[k - 1] / exact(times[k - 1]),
                             last / exact(times[k])});
        }
        std::optional<double> worst;
        for (const Stretch& at : history) {
          const double from = at.end - 0.5 * step(at.end), to = at.end + 0.5 * step(at.end);
          const bool fits =
              from >= std::max(0.5 * end, history.front().begin) && to <= history.back().end;
          if (!fits) continue;  // a step of NaN does not
          double sum = 0.0;
          for (const Stretch& stretch : history) sum += stretch.integral(from, to);
          const double mean = sum / (to - from);
          if (!worst || std::abs(mean - 1.0) > std::abs(*worst - 1.0)) worst = mean;
        }
        return worst;
      };
}

void compare_growth(Reference& reference, const OfGrowth& compared, const Reference::OfTime& step,
                    double end) {
  const auto& [quantity, place, unit, between, computed, exact] = compared;
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
                                  .computed = worst_mean_of_growth(step, end, exact, between)});
}

}  // namespace perifrac
