#include "app/references/moving_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace perifrac {

Reference::Computed edge_of(const Field& field, int axis, double spacing) {
  return [=] {
    const auto x = field.points().position[axis];
    return x.empty() ? NAN : std::ranges::max(x) + 0.5 * spacing;
  };
}

Reference::Computed mean_between(const Field& field, int component, int axis, double low,
                                 double high) {
  return [=] {
    const auto x = field.points().position[axis];
    const auto values = field.values().subspan(component * x.size());
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < low || x[i] >= high) continue;
      sum += values[i];
      ++count;
    }
    return sum / count;
  };
}

Reference::Profile profile_over_layers(const Field& field, int component, int axis, double low,
                                       double high, double spacing, const std::string& quantity,
                                       std::function<double(double x, double t)> exact) {
  constexpr std::array names = {"x", "y", "z"};
  std::vector<double> x;
  std::vector<Reference::Computed> means;
  const int layers = static_cast<int>(std::lround((high - low) / spacing));
  for (int n = 0; n < layers; ++n) {
    const double from = low + n * spacing, to = low + (n + 1) * spacing;
    x.push_back(0.5 * (from + to));
    means.push_back(mean_between(field, component, axis, from, to));
  }
  return {.name = fmt::format("{} along {}", quantity, names[axis]),
          .unit = field.port.unit,
          .x_name = names[axis],
          .x = std::move(x),
          .computed = [means = std::move(means)](std::size_t n) { return means[n](); },
          .exact = std::move(exact)};
}

}  // namespace perifrac
