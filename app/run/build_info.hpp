#pragma once

#include <nlohmann/json_fwd.hpp>

namespace perifrac {

/// What made this program: compiler, flags, the sparse factor it holds, the commit.
nlohmann::json build_info();

/// What it runs on: host, processor, cores that it may use, memory [bytes].
nlohmann::json machine_info();

}  // namespace perifrac
