#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"
#include "app/warnings/regime.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The crack in an infinite body that a scene's crack comes nearest to, when most fluid is in it.
struct SceneRegime {
  HydraulicFracture fracture;
  int wings;                    ///< of it, that the body holds
  double time;                  ///< in which the inlet's full rate brings as much [s]
  bool is_as_in_infinite_body;  ///< the body's faces are far enough off
  /// Where what the scene does is not what that crack does, or is resolved too coarsely.
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< likewise, where the answer of a run does not depend on it
};

/// Nothing unless the scene pumps fluid at one inlet, by rate, into a crack that grows by its
/// fracture energy. Throws InputError.
std::optional<SceneRegime> regime_of(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
