#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/simulation/simulation.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

/// What every part of a run took up to now: `parts`, a tree in which each one's figures hold those
/// of the parts in it, with shares of the whole; `unaccounted`, what is in none; `memory`.
///
/// `heap_bytes` are what the heap grew by in a part, measured: arrays, matrices and factors that it
/// made and still holds, not what it held for a while. `field_bytes` are counted: the evolving
/// fields, as `perifrac check` lists them, and the families, where the body's are first asked for.
nlohmann::json profile_json(Profile& profile, const Simulation& simulation);

/// The same as a table.
std::string profile_text(const nlohmann::json& profile);

}  // namespace perifrac
