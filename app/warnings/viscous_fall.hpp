#pragma once

#include <span>

#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// The fall of pressure over length that a viscosity of 1 takes up in a fluid that moves so
/// [1/(m s)]: what it dissipates, by twice the mean square of the strain rate, over the mean
/// speed; in a straight channel that is the fall along it. `velocity`: component by component
/// [m/s]; `reach`: of the neighbours that gradients are found from [m]. 0 in a fluid at rest.
template <int D>
double viscous_fall(const Positions<D>& places, std::span<const double> velocity, double reach);

}  // namespace perifrac
