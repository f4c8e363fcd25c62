#pragma once

#include <optional>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/fracture/fracture_energy.hpp"
#include "modules/solid/fracture/tensile_strength.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// The keys of the section `damage`.
KeyTable damage_keys();

/// The scene's bonds break by critical_stretch.
bool names_critical_stretch(const Section& scene);

/// What new crack takes outside `damage.regions` [J/m^2], whichever way the scene says it. Throws
/// InputError where it does not, or twice.
double read_fracture_energy(const Section& scene);

/// What the scene's cracks grow at; infinite without a section `damage`. Throws InputError for
/// another criterion than energy_release.
template <int D>
FractureEnergy<D> read_fracture_energy(const Section& scene, const Body<D>& body);

/// At which cracks begin by themselves; nothing where the scene has none. Throws InputError.
template <int D>
std::optional<TensileStrength<D>> read_tensile_strength(const Section& scene, const Body<D>& body);

/// The stretch at which bonds of this rock break by critical_stretch. Throws InputError.
template <int D>
double read_stretch_limit(const Section& scene, const Body<D>& body, const Family<D>& family,
                          const IsotropicElasticity<D>& law);

}  // namespace perifrac
