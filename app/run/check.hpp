#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// What `perifrac check` was asked for.
struct CheckRequest {
  std::string scene;                   ///< file
  std::vector<std::string> overrides;  ///< `key=value` of --set
  bool json = false;
  bool arrays = false;         ///< print links and arrays too
  std::string picture{};       ///< file to draw the set-up in; empty: none
  double trial_seconds = 0.0;  ///< try the first windows for so long; 0: do not
};

/// `perifrac check`: builds all that the scene calls for and prints what that is: effects, points,
/// what was read, warnings; of a crack that fluid drives also its regime (regime.hpp). Writes
/// nothing but a picture of the set-up, where one is asked for. A trial says what the whole run
/// would take (forecast.hpp). Where a scene takes more memory than is free, it says so and builds
/// nothing. Throws InputError.
int check_scene(const CheckRequest& request);

}  // namespace perifrac
