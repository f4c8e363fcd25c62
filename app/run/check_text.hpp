#pragma once

#include <nlohmann/json_fwd.hpp>

namespace perifrac {

/// Prints what `perifrac check` found: what is simulated, its size, what was read, regime, time and
/// memory, warnings; with `arrays` also links and every evolving array.
void print_check(const nlohmann::json& result, bool arrays);

}  // namespace perifrac
