#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// `perifrac check`: builds all that the scene calls for without running it or writing anything,
/// and prints what that is: effects, points, bonds, evolving arrays and bytes; of a crack that
/// fluid drives also its regime (regime.hpp). Throws InputError.
int check_scene(const std::string& scene_file, const std::vector<std::string>& overrides,
                bool json);

}  // namespace perifrac
