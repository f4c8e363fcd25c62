#pragma once

#include "core/base/errors.hpp"

namespace perifrac {

/// A NumericalError that no shorter window gets past: none is tried.
class FinalError : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

}  // namespace perifrac
