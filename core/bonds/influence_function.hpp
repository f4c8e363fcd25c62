#pragma once

#include <cmath>
#include <string_view>

namespace perifrac {

/// How the weight of a bond falls with its length; the scale cancels in every operator.
enum class InfluenceFunction {
  gaussian,  ///< exp(-(r / 0.4 horizon)^2), the paper's
  constant,  ///< 1
  inverse,   ///< horizon / r
};

/// omega(r) for 0 < r <= horizon [m].
inline double influence(InfluenceFunction function, double r, double horizon) {
  switch (function) {
    case InfluenceFunction::gaussian: {
      const double s = r / (0.4 * horizon);
      return std::exp(-s * s);
    }
    case InfluenceFunction::constant:
      return 1.0;
    case InfluenceFunction::inverse:
      return horizon / r;
  }
  return 0.0;
}

/// The function a scene names; the reader has checked the word.
inline InfluenceFunction influence_function(std::string_view word) {
  if (word == "constant") return InfluenceFunction::constant;
  if (word == "inverse") return InfluenceFunction::inverse;
  return InfluenceFunction::gaussian;
}

}  // namespace perifrac
