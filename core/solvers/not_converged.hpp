#pragma once

#include <stdexcept>

namespace perifrac {

/// An iteration that does not get to its tolerance.
class NotConverged : public std::runtime_error {
 public:
  NotConverged(int iterations, double residual);
};

}  // namespace perifrac
