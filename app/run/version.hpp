#pragma once

namespace perifrac {

/// Of this program, from the build.
inline constexpr const char* version = PERIFRAC_VERSION;

}  // namespace perifrac
