#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/state/snapshot.hpp"

namespace perifrac {

/// All that a run needs to go on as if it had never stopped.
struct Checkpoint {
  double time = 0.0;  ///< [s]
  std::int64_t step = 0;
  std::string scene{};    ///< the scene's text, as run
  std::string version{};  ///< of the program that wrote it
  Snapshot state{};
};

/// Writes DIR/checkpoint_<step>.h5 atomically and returns its path. Of the others in the folder
/// only the last one before it is kept: later ones are of a course of events that a restart has
/// given up. The file carries a checksum over all of it. Throws OutputError, the others untouched.
std::filesystem::path write_checkpoint(const std::filesystem::path& output_folder,
                                       const Checkpoint& checkpoint);

/// Throws InputError for a file that is missing, not a checkpoint, cut short or damaged by as
/// little as one bit.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace perifrac
