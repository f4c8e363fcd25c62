#pragma once

#include <cmath>
#include <type_traits>

#include "core/base/packet.hpp"

namespace perifrac {

/// The influence of smoothed particle hydrodynamics, -W'(r) / r of the Wendland C2 kernel W over
/// its value at r = 0: (1 - r / horizon)^3, 0 beyond the horizon (Wendland 1995). W is
/// (1 - r / horizon)^4 (1 + 4 r / horizon) over its integral; its gradient at x_i is omega times
/// the vector to x_j.
class WendlandInfluence {
 public:
  /// `horizon` in [m].
  explicit WendlandInfluence(double horizon) : inverse_(1.0 / horizon) {}

  /// omega at r^2 [m^2]; Number is double or Packet.
  template <class Number>
  Number operator()(const Number& r_square) const {
    const Number rest = 1.0 - inverse_ * root(r_square);
    return rest > 0.0 ? rest * rest * rest : Number{};
  }

 private:
  template <class Number>
  static Number root(const Number& square) {
    if constexpr (std::is_same_v<Number, double>) {
      return std::sqrt(square);
    } else {
      Packet result;
      for (int l = 0; l < packet_size; ++l) result[l] = std::sqrt(square[l]);
      return result;
    }
  }

  double inverse_;
};

}  // namespace perifrac
