#pragma once

#include <optional>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// Times of frames after the start, sorted, each once [s]: `output.times`, the multiples of
/// `output.interval`, and the scene's end. `until` ends them earlier or later and is then the last;
/// the others stay what they are, so that a run in parts is the run in one. Throws InputError for a
/// written time beyond the scene's end.
std::vector<double> read_output_times(const Section& output, double scene_end,
                                      std::optional<double> until = {});

}  // namespace perifrac
