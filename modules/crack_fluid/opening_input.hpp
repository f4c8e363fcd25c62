#pragma once

#include <cstddef>
#include <vector>

namespace perifrac {

/// How wide facets are [m]: value, rate, and slope against pressure, a matrix [m/Pa].
struct OpeningInput {
  std::vector<double> value, rate, slope;

  void match(std::size_t count) {
    value.resize(count);
    rate.resize(count);
    if (slope.size() != count * count) slope.assign(count * count, 0.0);
  }

  bool fits(std::size_t count) const {
    return value.size() == count && rate.size() == count && slope.size() == count * count;
  }
};

}  // namespace perifrac
