#pragma once

#include <array>

namespace perifrac {

/// R rows by D columns, row by row: the gradient of an R-component field in D dimensions, or what
/// is conjugate to it.
template <int R, int D>
using Tensor = std::array<double, R * D>;

}  // namespace perifrac
