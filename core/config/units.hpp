#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace perifrac {

/// A text that is not a finite quantity of the wanted dimension; what() reads `problem; expected`.
class QuantityError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a decimal number with an optional unit, as in `0.21 MPa`, into the SI unit `unit` (empty:
/// dimensionless). A bare number is in `unit` already. Besides what udunits knows there are darcy
/// (`mD`), poise (`cP`) and a closing `*sqrt(m)` or `*sqrt(s)`. Throws QuantityError; among what it
/// refuses are nan, inf, hexadecimal numbers, decimal exponents, units that count from another zero
/// (degC), reciprocals (`Hz` for `s`) and `a`, which may be an are or a year.
double to_si(std::string_view text, std::string_view unit);

/// The wanted quantity in words, as in `a pressure [Pa], such as '1 MPa'`.
std::string describe_quantity(std::string_view unit);

}  // namespace perifrac
