#include "core/state/finite_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.hpp"

namespace perifrac {

void FiniteCheck::real(const std::string& name, std::vector<double>& values) {
  const auto bad =
      std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
  if (bad != values.end()) {
    const auto index = static_cast<std::size_t>(bad - values.begin());
    throw NumericalError(name, place(index, values.size()), time_,
                         std::isnan(*bad) ? "not a number" : "infinite value");
  }
}

std::string FiniteCheck::place(std::size_t index, std::size_t size) const {
  if (points_ == nullptr || points_->dimension == 0 || size % points_->count != 0) {
    return fmt::format("value {} of {}", index, size);
  }
  const std::size_t point = index % points_->count;  // arrays go component by component
  std::vector<double> position;
  for (int axis = 0; axis < points_->dimension; ++axis) {
    position.push_back(points_->position[axis][point]);
  }
  return describe_point(point, position);
}

}  // namespace perifrac
