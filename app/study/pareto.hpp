#pragma once

#include <optional>
#include <span>
#include <vector>

namespace perifrac {

/// Error against cost of one variant; both are finite and not negative.
struct ErrorAndCost {
  double error;
  double cost;
};

/// Those that no other one beats in both: by rising cost, with falling error. Of equals the first.
std::vector<std::size_t> pareto_front(std::span<const ErrorAndCost> points);

/// Those that reach `accuracy`, the cheapest first.
std::vector<std::size_t> cheapest(std::span<const ErrorAndCost> points, double accuracy);

}  // namespace perifrac
