#pragma once

#include <stdexcept>

namespace perifrac {

/// What has to be so for what follows not to write out of bounds; not for hot loops. A mistake in
/// the program.
inline void require(bool holds, const char* what) {
  if (!holds) [[unlikely]]
    throw std::logic_error(what);
}

}  // namespace perifrac
