#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace perifrac {

/// The set that loops over bonds are compiled for, and how many numbers it takes at once, as in
/// `AVX-512, 8 numbers at once`. Installed programs hold several (docs/install.md).
std::string instruction_set();

/// What made this program: compiler, flags, the sparse factor it holds, the commit.
nlohmann::json build_info();

/// What it runs on: host, processor, cores that it may use, memory [bytes].
nlohmann::json machine_info();

}  // namespace perifrac
