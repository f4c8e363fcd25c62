#pragma once

#include <string>

namespace perifrac {

/// What `perifrac export` was asked for, as its script takes it.
struct ExportRequest {
  std::string folder;          ///< of a run
  std::string frame = "last";  ///< first, last, all, a number from 0, or a time with its unit
  std::string to = "vtu";      ///< vtu or csv
  std::string output{};        ///< folder; empty: `export` in that of the run
};

/// Writes frames of a run for other programs. Returns the script's exit code. Throws InputError.
int export_frames(const ExportRequest& request);

}  // namespace perifrac
