#include "core/body/most_points.hpp"

#include <fmt/format.h>

namespace perifrac {

void refuse_too_many_points(const Section& section, const std::string& path, double points,
                            double spacing) {
  constexpr double most = 1e8;
  if (points <= most) return;
  section.fail(path, fmt::format("{:.2g} points at a spacing of {:g} m", points, spacing),
               fmt::format("at most {:g}", most));
}

}  // namespace perifrac
