#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// How long the cracks of a scene get in the end [m], in 3D their area [m^2], from a run of the
/// same scene on points some times as far apart, which takes a hundredth of the time: bodies of any
/// shape are in it, which the regime's solutions, of an infinite body, are not. Nothing where no
/// crack of the scene grows by its fracture energy, the scene cannot be had on fewer points, or
/// that run stops or takes more than `seconds` of processor time. `scene_file` and `overrides` are
/// those that `scene` was read from.
std::optional<double> crack_size_of_coarse_twin(const std::string& scene_file,
                                                std::vector<std::string> overrides,
                                                const Section& scene, double seconds);

}  // namespace perifrac
