#pragma once

#include <ctime>

namespace perifrac {

/// Of all threads of this process so far [s]: what other programs do costs none of it.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace perifrac
