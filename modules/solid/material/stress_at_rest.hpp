#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/material/initial_stress.hpp"

namespace perifrac {

/// The keys of `confining_stress`, `total_stress` and `stress_gradient`.
KeyTable stress_at_rest_keys();

/// What a scene says of the stress outside `regions`, at its datum, compressive positive, by axis
/// [Pa].
struct StatedStress {
  std::string key;  ///< in the solid's section
  std::vector<double> effective;
  std::vector<double> total;
  double biot_coefficient;         ///< 0 without pore flow
  double pore_pressure;            ///< at the start [Pa]
  bool pores_vary = false;         ///< then at the highest corner, or the origin
  std::vector<double> gradient{};  ///< how it grows with depth; empty: not [Pa/m]
  double datum = 0.0;              ///< height [m]

  /// The total stress at a height.
  double total_at(int axis, double height) const {
    return total[axis] + (gradient.empty() ? 0.0 : gradient[axis] * (datum - height));
  }
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
