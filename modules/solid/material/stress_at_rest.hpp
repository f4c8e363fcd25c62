#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/material/initial_stress.hpp"

namespace perifrac {

/// The keys of `confining_stress` and `total_stress`.
KeyTable stress_at_rest_keys();

/// What a scene says of the stress outside `regions`, compressive positive, by axis [Pa].
struct StatedStress {
  std::string key;  ///< in the solid's section
  std::vector<double> effective;
  std::vector<double> total;
  double biot_coefficient;  ///< 0 without pore flow
  double pore_pressure;     ///< at the start [Pa]
};

/// Nothing where the scene has none. Throws InputError where it says both, or not enough.
std::optional<StatedStress> read_stated_stress(const Section& scene);

/// What new faces are relieved of: the effective stress, or with `total_stress` the total one.
/// Nothing where the scene has none; throws InputError, also where regions have another and the
/// body would not be at rest.
template <int D>
std::optional<InitialStress<D>> read_initial_stress(const Section& section, const Body<D>& body);

/// The same of a body that is the same everywhere.
template <int D>
std::optional<Vector<D>> read_uniform_stress(const Section& section);

/// Beside `total_stress`, alpha p0 of every point: the part of the pore stress that what lies
/// behind the faces bears, so that only what comes to it loads the rock [Pa]. Else empty.
template <int D>
std::vector<double> read_pore_stress_at_rest(const Section& section, const Body<D>& body);

}  // namespace perifrac
