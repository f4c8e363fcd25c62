#pragma once

#include <optional>
#include <string>
#include <vector>

namespace perifrac {

/// What `perifrac run` was asked for.
struct RunRequest {
  std::string scene;                   ///< file
  std::vector<std::string> overrides;  ///< `key=value` of --set
  std::string output;                  ///< folder; empty: runs/<name of the scene>
  std::string restart;                 ///< checkpoint to go on from; empty: start anew
  std::string until;                   ///< replaces time.end; empty: as in the scene
  bool json = false;                   ///< summary on standard output as JSON
  bool report = true;                  ///< make the picture and the page at the end
};

/// Runs the scene and returns the program's exit code. Throws InputError before anything is
/// written, and OutputError.
int run_scene(const RunRequest& request);

}  // namespace perifrac
