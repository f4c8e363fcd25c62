#pragma once

#include <span>

#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// What a viscosity of 1 takes from a fluid that moves so, per volume [1/s^2]: twice the square of
/// the strain rate, in the mean over its points. `velocity`: component by component [m/s]; `reach`:
/// of the neighbours that gradients are found from [m].
template <int D>
double mean_dissipation(const Positions<D>& places, std::span<const double> velocity, double reach);

}  // namespace perifrac
