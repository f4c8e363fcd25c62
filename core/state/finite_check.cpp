#include "core/state/finite_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/state/all_finite.hpp"

namespace perifrac {

void FiniteCheck::real(const std::string& name, std::vector<double>& values) {
  if (all_finite(values)) return;
  const auto bad =
      std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
  const auto index = static_cast<std::size_t>(bad - values.begin());
  throw NumericalError(name, place(name, index, values.size()), time_,
                       std::isnan(*bad) ? "not a number" : "infinite value");
}

std::string FiniteCheck::place(const std::string& name, std::size_t index, std::size_t size) const {
  const PointSet* const points = points_of_ ? points_of_(name) : nullptr;
  const bool on_points = points && points->dimension > 0 && points->count > 0;
  if (!on_points || size % points->count != 0) return fmt::format("value {} of {}", index, size);
  const std::size_t point = index % points->count;  // arrays go component by component
  std::vector<double> position;
  for (int axis = 0; axis < points->dimension; ++axis) {
    position.push_back(points->position[axis][point]);
  }
  return describe_point(point, position);
}

}  // namespace perifrac
