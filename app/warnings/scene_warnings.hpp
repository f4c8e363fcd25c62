#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"
#include "app/warnings/scene_regime.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// What is known of a scene before it runs and will probably make its answer wrong, one sentence
/// each: `check` and `run` say the same. `regime` is what regime_of() gave.
std::vector<std::string> scene_warnings(const Section& scene,
                                        const std::optional<SceneRegime>& regime);

}  // namespace perifrac
