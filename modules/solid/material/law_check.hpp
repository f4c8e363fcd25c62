#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/random_bits.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// Energy per volume at a gradient of displacement [J/m^3]: the law's own, or that of a linear one.
template <class Law, std::size_t N>
double law_energy(const Law& law, const std::array<double, N>& gradient) {
  if constexpr (requires { law.energy(gradient); }) {
    return law.energy(gradient);
  } else {
    const std::array<double, N> stress = law.stress(gradient);
    return 0.5 * dot(gradient, stress);
  }
}

/// Whether forces follow displacements linearly; a law that does not say so does.
template <class Law>
constexpr bool is_linear_law() {
  if constexpr (requires { Law::is_linear; }) return Law::is_linear;
  return true;
}

/// What is wrong with a law of elasticity, found by finite differences at a few random gradients of
/// displacement of `size`; empty: nothing. Stress is the derivative of the energy, so that its own
/// derivative, the tangent, is symmetric; it resists every small strain, and a linear law takes
/// rotations for nothing. Cheap: some thousand stresses.
template <int D, class Law>
std::string law_problem(const Law& law, double size = 1e-3) {
  constexpr std::size_t N = D * D;
  using Gradient = std::array<double, N>;
  constexpr double step = 1e-4, tolerance = 1e-5;  // of size, of stress: second differences
  std::uint64_t drawn = 0;
  const auto draw = [&] {
    Gradient g;
    for (double& value : g) value = size * uniform(random_bits(29, drawn++));
    return g;
  };
  const auto scale = [](const Gradient& a) { return std::sqrt(squared_norm(a)); };
  const auto moved = [](Gradient g, std::size_t k, double by) {
    g[k] += by;
    return g;
  };
  if (!(law.stabilisation() > 0.0) || !(law.drained_bulk_modulus() > 0.0)) {
    return "its stabilisation and drained bulk modulus are not both above 0";
  }
  for (int n = 0; n < 8; ++n) {
    const Gradient f = draw(), g = draw();
    const Gradient stress = law.stress(f);
    const double most = std::max(scale(stress), scale(law.stress(g)));
    if (!std::isfinite(most))
      return fmt::format("its stress at strains of {:g} is not finite", size);
    for (std::size_t k = 0; k < N; ++k) {
      const double h = step * size;
      const double slope =
          (law_energy(law, moved(f, k, h)) - law_energy(law, moved(f, k, -h))) / (2.0 * h);
      if (std::abs(slope - stress[k]) <= tolerance * most) continue;
      return fmt::format(
          "its stress {:.6g} Pa (component {}, strains of {:g}) is not the derivative "
          "of its energy, {:.6g} Pa",
          stress[k], k, size, slope);
    }
    Gradient strain, spin;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) {
        strain[a * D + b] = 0.5 * (f[a * D + b] + f[b * D + a]);
        spin[a * D + b] = 0.5 * (f[a * D + b] - f[b * D + a]);
      }
    }
    const double small = 1e-6;
    const Gradient little = law.stress(small * strain);
    if (!(dot(little, strain) > 0.0)) return "it does not resist a small strain";
    if constexpr (is_linear_law<Law>()) {
      if (scale(law.stress(f + g) - stress - law.stress(g)) > 1e-9 * most) {
        return "it says that it is linear, and is not";
      }
      if (scale(law.stress(spin)) > 1e-9 * most) return "a rotation alone makes stress";
    }
  }
  return "";
}

}  // namespace perifrac
