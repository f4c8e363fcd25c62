#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// What this process may still take [bytes]: the least of its share of what the machine has free,
/// what a limit on this process leaves (ulimit -v), and its share of what one on its group does.
double available_memory();

/// What this process has held at most so far [bytes]; not what the process that began it held,
/// which getrusage() counts too.
long peak_memory();

/// From now on the process is refused memory beyond what is free now, as by a limit (ulimit -d):
/// it can say so, where the system would end it without a word.
void keep_to_free_memory();

/// What a scene will take at most, roughly, known before anything is built.
struct MemoryEstimate {
  double points;  ///< of the body
  double bytes;
};

/// Nothing for a scene without a body that is a lattice. Measured on scenes of 1e3 to 1e5 points: a
/// guide, good to a factor of 1.5.
std::optional<MemoryEstimate> estimate_memory(const Section& scene);

/// Refuses a scene that needs far more than is free, at its spacing; one that may need more will be
/// told so by an allocation that fails. Throws InputError.
void require_memory(const Section& scene);

/// `about 21 GB for 750000 points, and 10 GB are free`.
std::string describe(const MemoryEstimate& estimate, double available);

}  // namespace perifrac
