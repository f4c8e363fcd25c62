#pragma once

#include <random>

#include "core/base/small_vector.hpp"

namespace perifrac::test {

/// A law with no symmetry but that of its energy: whatever holds for it holds for every law.
template <int R, int D>
struct AnyLaw {
  static constexpr int components = R;

  std::array<double, R * D * R * D> modulus{};

  AnyLaw() {
    std::mt19937 bits(11);
    std::uniform_real_distribution<double> value(-0.3, 0.3);
    for (int k = 0; k < R * D; ++k) {
      for (int l = 0; l <= k; ++l) {
        modulus[k * R * D + l] = modulus[l * R * D + k] = value(bits) + (k == l ? 2.0 : 0.0);
      }
    }
  }

  template <class Number>
  std::array<Number, R * D> stress(const std::array<Number, R * D>& gradient) const {
    std::array<Number, R * D> result{};
    for (int k = 0; k < R * D; ++k) {
      for (int l = 0; l < R * D; ++l) result[k] += modulus[k * R * D + l] * gradient[l];
    }
    return result;
  }

  double stabilisation() const { return 1.7; }
};

}  // namespace perifrac::test
