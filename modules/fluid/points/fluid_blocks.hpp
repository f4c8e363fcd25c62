#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/fluid_properties.hpp"

namespace perifrac {

/// The keys of `blocks` in the section of the fluid.
KeyTable fluid_block_keys();

/// The fluid that is there at the start: boxes filled with points at cell centres, at one pressure
/// or at rest under gravity. Throws InputError.
template <int D>
FluidPoints<D> read_fluid_blocks(const Section& section, const FluidProperties& fluid,
                                 double spacing, const Vector<D>& gravity);

/// Points at the centres of the cells of the box `path`.from, `path`.to. Throws InputError.
template <int D>
Points<D> box_points(const Section& section, const std::string& path, double spacing);

/// Cells of `spacing` along each axis of the box `path`.from, `path`.to; throws InputError where
/// they are no whole number.
template <int D>
std::array<int, D> cells_of_box(const Section& section, const std::string& path, double spacing);

}  // namespace perifrac
