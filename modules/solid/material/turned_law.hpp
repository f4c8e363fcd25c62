#pragma once

#include <array>
#include <cmath>

#include "core/base/packet.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// F = I + gradient = R U, R being the rotation next to F.
template <int D, class Number = double>
struct Turned {
  std::array<Number, D * D> rotation;  ///< R
  std::array<Number, D * D> strain;    ///< U - I, symmetric
};

inline double square_root(double x) { return std::sqrt(x); }
inline Packet square_root(const Packet& x) {
  Packet result;
  for (int l = 0; l < packet_size; ++l) result[l] = std::sqrt(x[l]);
  return result;
}

/// In closed form, with no loss of digits where little turns; a point that collapsed, tr U = 0,
/// counts as not turned. Numbers or packets.
template <class Number>
Turned<2, Number> turned(const std::array<Number, 4>& g) {
  const Number zero{}, one = zero + 1.0;
  const Number a = 2.0 + g[0] + g[3], b = g[2] - g[1];
  const Number trace = square_root(a * a + b * b);
  const Number c = trace > 0.0 ? a / trace : one;
  const Number s = trace > 0.0 ? b / trace : zero;
  const Number less = c > 0.0 ? -s * s / (1.0 + c) : c - 1.0;  // c - 1
  const Number shear = 0.5 * (c * (g[1] + g[2]) + s * (g[3] - g[0]));
  return {.rotation = {c, -s, s, c},
          .strain = {less + c * g[0] + s * g[2], shear, shear, less + c * g[3] - s * g[1]}};
}

/// By Newton's iteration for the polar factor; by singular values where F is near to collapse or
/// turned inside out.
Turned<3> turned(const Tensor<3, 3>& gradient);

/// Packets of what is told number by number.
inline Turned<3, Packet> turned(const std::array<Packet, 9>& gradient) {
  Turned<3, Packet> result;
  for (int l = 0; l < packet_size; ++l) {
    Tensor<3, 3> own;
    for (int k = 0; k < 9; ++k) own[k] = gradient[k][l];
    const Turned<3> one = turned(own);
    for (int k = 0; k < 9; ++k) {
      result.rotation[k][l] = one.rotation[k];
      result.strain[k][l] = one.strain[k];
    }
  }
  return result;
}

/// A B.
template <int D, class Number>
std::array<Number, D * D> product(const std::array<Number, D * D>& a,
                                  const std::array<Number, D * D>& b) {
  std::array<Number, D * D> result{};
  for (int r = 0; r < D; ++r) {
    for (int c = 0; c < D; ++c) {
      for (int k = 0; k < D; ++k) result[r * D + c] += a[r * D + k] * b[k * D + c];
    }
  }
  return result;
}

}  // namespace perifrac
