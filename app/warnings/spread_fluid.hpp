#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// How much of the room about them points of a fluid fill, each `volume` large [m^D], in the mean
/// over those with others on all sides; 1 where there are hardly any. About 1.01 on a lattice.
template <int D>
double filled_part(const Positions<D>& places, std::span<const double> volume, double spacing);

/// Where free fluid fills more room in the end than it has volume. Density is what continuity
/// remembers: points that a blow has driven apart do not close up again at the pressure that they
/// had. Those that pores have made lighter keep their room and do not count as spread.
std::optional<std::string> spread_fluid_warning(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
