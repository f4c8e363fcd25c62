#pragma once

#include "modules/fluid/method/fluid_method.hpp"

namespace perifrac {

/// `semi_lagrangian`, the paper's method (section 2.4): Gaussian influence, and in every operator
/// the inverse of each point's own shape tensor.
FluidMethodType semi_lagrangian_method();

}  // namespace perifrac
