#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// What `perifrac check` was asked for.
struct CheckRequest {
  std::string scene;                   ///< file
  std::vector<std::string> overrides;  ///< `key=value` of --set
  bool json = false;
  double trial_seconds = 0.0;  ///< try the first windows for so long; 0: do not
};

/// `perifrac check`: builds all that the scene calls for without writing anything, and prints what
/// that is: effects, points, bonds, evolving arrays and bytes; of a crack that fluid drives also
/// its regime (regime.hpp). A trial says what the whole run would take (forecast.hpp). Where a
/// scene takes more memory than is free, it says so and builds nothing. Throws InputError.
int check_scene(const CheckRequest& request);

}  // namespace perifrac
