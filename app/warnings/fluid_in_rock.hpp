#pragma once

#include <cstddef>
#include <span>

#include "core/body/body.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// Points of free fluid that lie in the rock, a spacing deep or more, and one of them.
struct FluidInRock {
  std::size_t count = 0;
  std::size_t one = 0;
};

/// `displacement` of the body's points, component by component, or empty [m]. Where the rock about
/// a point, weighted to two and a half spacings, fills nine tenths of what is there: no surface,
/// corner or slit of a spacing lets it come near to that.
template <int D>
FluidInRock fluid_in_rock(const Body<D>& body, std::span<const double> displacement,
                          const Positions<D>& fluid);

}  // namespace perifrac
