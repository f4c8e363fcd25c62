#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/random_bits.hpp"
#include "core/base/small_vector.hpp"
#include "modules/solid/material/law_field.hpp"

namespace perifrac {

/// What is wrong with a law of elasticity, found by finite differences at a few random gradients of
/// displacement of `size`; empty: nothing. Cheap: some ten thousand stresses.
///  - Stress is the derivative of the energy, its own derivative, the tangent, is symmetric, and it
///    resists every small strain.
///  - A linear law is linear, and takes rotations for nothing.
///  - Of a law with a memory, energy and its derivative are those at the memory that has followed;
///    the tangent is that before it has. What is there already changes nothing, and on the way
///    there what is stored and turned into heat is what was done on it.
template <int D, class Law>
class LawCheck {
 public:
  using Gradient = std::array<double, D * D>;

  LawCheck(const Law& law, double size) : law_(law), size_(size) {}

  std::string problem() {
    if (!(law_.stabilisation() > 0.0) || !(law_.drained_bulk_modulus() > 0.0)) {
      return "its stabilisation and drained bulk modulus are not both above 0";
    }
    for (int n = 0; n < 8; ++n) {
      const Gradient f = draw();
      for (const std::string& found :
           {not_finite(f), not_derived(f), not_symmetric(f), not_linear(f), not_remembered(f)}) {
        if (!found.empty()) return found;
      }
    }
    return "";
  }

 private:
  static constexpr double step = 1e-4, tolerance = 1e-5;  // of size, of stress: second differences

  static double length(const Gradient& a) { return std::sqrt(squared_norm(a)); }
  static Gradient moved(Gradient g, std::size_t k, double by) {
    g[k] += by;
    return g;
  }
  static Gradient transposed(const Gradient& g) {
    Gradient result;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) result[a * D + b] = g[b * D + a];
    }
    return result;
  }

  Gradient draw() {
    Gradient g;
    for (double& value : g) value = size_ * uniform(random_bits(29, drawn_++));
    return g;
  }
  Gradient stress(const Gradient& g, const Memory<Law>& memory = {}) const {
    return law_stress(law_, g, memory);
  }
  double energy(const Gradient& g, const Memory<Law>& memory) const {
    return law_energy(law_, g, memory);
  }
  /// What it remembers at once after it was taken to g, and the heat of that.
  double follow(const Gradient& g, Memory<Law>& memory) const {
    if constexpr (memory_of<Law>() > 0) return law_.follow(g, memory, 0.0);
    return 0.0;
  }

  std::string not_finite(const Gradient& f) const {
    if (std::isfinite(length(stress(f)))) return "";
    return fmt::format("its stress at strains of {:g} is not finite", size_);
  }

  std::string not_derived(const Gradient& f) const {
    Memory<Law> memory{};
    follow(f, memory);
    const Gradient found = stress(f, memory);
    const double h = step * size_;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double slope =
          (energy(moved(f, k, h), memory) - energy(moved(f, k, -h), memory)) / (2.0 * h);
      if (std::abs(slope - found[k]) <= tolerance * length(found)) continue;
      return fmt::format(
          "its stress {:.6g} Pa (component {}, strains of {:g}) is not the derivative of its "
          "energy, {:.6g} Pa",
          found[k], k, size_, slope);
    }
    const Gradient strain = 0.5 * (f + transposed(f));
    const double small = 1e-6;
    return dot(stress(small * strain), strain) > 0.0 ? "" : "it does not resist a small strain";
  }

  std::string not_symmetric(const Gradient& f) const {
    const double h = step * size_;
    std::array<Gradient, D * D> tangent;
    double most = 0.0;
    for (std::size_t k = 0; k < tangent.size(); ++k) {
      tangent[k] = (stress(moved(f, k, h)) - stress(moved(f, k, -h))) / (2.0 * h);
      most = std::max(most, length(tangent[k]));
    }
    for (std::size_t k = 0; k < tangent.size(); ++k) {
      for (std::size_t l = 0; l < k; ++l) {
        if (std::abs(tangent[k][l] - tangent[l][k]) <= 1e-3 * most) continue;
        return fmt::format(
            "its tangent is not symmetric: components {} and {} answer each other with {:.6g} Pa "
            "and {:.6g} Pa",
            k, l, tangent[l][k], tangent[k][l]);
      }
    }
    return "";
  }

  std::string not_linear(const Gradient& f) {
    if constexpr (is_linear_law<Law>()) {
      const Gradient g = draw(), spin = 0.5 * (f - transposed(f));
      const double most = std::max(length(stress(f)), length(stress(g)));
      if (length(stress(f + g) - stress(f) - stress(g)) > 1e-9 * most) {
        return "it says that it is linear, and is not";
      }
      if (length(stress(spin)) > 1e-9 * most) return "a rotation alone makes stress";
    }
    return "";
  }

  std::string not_remembered(const Gradient& f) const {
    if constexpr (memory_of<Law>() == 0) return "";
    constexpr int steps = 1000;
    Memory<Law> memory{};
    Gradient before = stress({});
    double work = 0.0, heat = 0.0;
    for (int n = 1; n <= steps; ++n) {
      const Gradient g = (1.0 * n / steps) * f;
      heat += follow(g, memory);
      const Gradient now = stress(g, memory);
      work += 0.5 / steps * dot(before + now, f);
      before = now;
    }
    const double stored = energy(f, memory) - energy({}, {});
    if (std::abs(work - stored - heat) > 1e-2 * std::abs(work)) {
      return fmt::format(
          "of the {:.6g} J/m^3 that took it to strains of {:g} it stores {:.6g} and turns {:.6g} "
          "into heat",
          work, size_, stored, heat);
    }
    if (heat < -1e-6 * std::abs(work)) return "its memory makes energy out of heat";
    Memory<Law> again = memory;
    follow(f, again);
    if (length(stress(f, again) - before) > tolerance * length(before)) {
      return "its memory goes on where nothing moves, in no time";
    }
    return "";
  }

  const Law& law_;
  double size_;
  std::uint64_t drawn_ = 0;
};

template <int D, class Law>
std::string law_problem(const Law& law, double size = 1e-3) {
  return LawCheck<D, Law>(law, size).problem();
}

}  // namespace perifrac
