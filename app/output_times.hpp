#pragma once

#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// Times of frames after the start, sorted, each once, `end` last [s]: `output.times` and the
/// multiples of `output.interval`. Throws InputError for a time beyond the end.
std::vector<double> read_output_times(const Section& output, double end);

}  // namespace perifrac
