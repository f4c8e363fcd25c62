#pragma once

#include <string>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Throws InputError where no picture can be written under that name.
void check_picture_name(const std::string& file);

/// Draws what a scene sets up, at t = 0: body, regions, cut-outs, cracks, conditions, loads, wells
/// and probes, as PNG or SVG by the file's ending. Throws OutputError where that fails.
void draw_setup(const Section& scene, const Simulation& simulation, const std::string& file);

}  // namespace perifrac
