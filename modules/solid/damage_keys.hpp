#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/body.hpp"
#include "modules/solid/fracture_energy.hpp"
#include "modules/solid/isotropic_elasticity.hpp"

namespace perifrac {

/// The keys of the section `damage`.
KeyTable damage_keys();

/// What the scene's cracks grow at; infinite without a section `damage`. Throws InputError for
/// another criterion than energy_release.
FractureEnergy<2> read_fracture_energy(const Section& scene, const Body<2>& body);

/// The stretch at which bonds of this rock break; infinite without a section `damage`. Throws
/// InputError for another criterion than critical_stretch.
template <int D>
double read_stretch_limit(const Section& scene, const Body<D>& body, const Family<D>& family,
                          const IsotropicElasticity<D>& law);

}  // namespace perifrac
