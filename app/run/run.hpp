#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/output_folder.hpp"

namespace perifrac {

/// What `perifrac run` was asked for.
struct RunRequest {
  std::string scene;                   ///< file
  std::vector<std::string> overrides;  ///< `key=value` of --set
  std::string output;                  ///< folder; empty: the checkpoint's, or runs/<scene>
  Overwrite overwrite = Overwrite::own;
  std::string restart;   ///< checkpoint to go on from; empty: start anew
  std::string until;     ///< where to end; empty: the scene's time.end
  bool json = false;     ///< summary on standard output as JSON
  bool profile = false;  ///< a table of time and memory by part
  bool watch = false;    ///< serve a page to watch it on while it runs
  bool report = true;    ///< make the picture and the page at the end
};

/// Runs the scene and returns the program's exit code. Throws InputError before anything is
/// written, and OutputError.
int run_scene(const RunRequest& request);

}  // namespace perifrac
