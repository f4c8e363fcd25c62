#include "core/base/errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

std::string describe_point(std::size_t point, std::span<const double> position) {
  return fmt::format("point {} at ({:.6g}) m", point, fmt::join(position, ", "));
}

NumericalError::NumericalError(std::string field, std::string place, double time,
                               std::string problem)
    : std::runtime_error(fmt::format("{} in {} at {}, t = {:.6g} s", problem, field, place, time)),
      field_(std::move(field)),
      place_(std::move(place)),
      time_(time) {}

OutputError::OutputError(const std::string& file, const std::string& reason)
    : std::runtime_error(fmt::format("{}: cannot be written: {}", file, reason)) {}

}  // namespace perifrac
