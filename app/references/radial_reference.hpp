#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// `reference.type: radial`: a quarter of a plane crack in a 3D body, from the corner of two planes
/// of symmetry where fluid is pumped in, against a penny-shaped one in an infinite body: radius of
/// a circle of the crack's area, net pressure and opening at the inlet. Throws InputError.
std::unique_ptr<Reference> make_radial_reference(const Section& scene,
                                                 const Simulation& simulation);

}  // namespace perifrac
