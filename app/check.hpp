#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// `perifrac check`: builds all that the scene calls for without writing anything, and prints what
/// that is: effects, points, bonds, evolving arrays and bytes; of a crack that fluid drives also
/// its regime (regime.hpp). `trial_seconds`: tries the first windows for so long and says what the
/// whole run would take (forecast.hpp); 0: does not. Throws InputError.
int check_scene(const std::string& scene_file, const std::vector<std::string>& overrides, bool json,
                double trial_seconds);

}  // namespace perifrac
