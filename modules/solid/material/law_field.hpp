#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// How many numbers a law remembers at a point; one that does not say so, none.
template <class Law>
constexpr std::size_t memory_of() {
  if constexpr (requires { Law::memory; }) return Law::memory;
  return 0;
}
template <class Law>
using Memory = std::array<double, memory_of<Law>()>;

/// Whether forces follow displacements linearly; a law that does not say so does, unless it has a
/// memory.
template <class Law>
constexpr bool is_linear_law() {
  if constexpr (requires { Law::is_linear; }) return Law::is_linear;
  return memory_of<Law>() == 0;
}

/// Stress at a gradient of displacement, with the memory that the law has [Pa].
template <class Law, std::size_t N>
std::array<double, N> law_stress(const Law& law, const std::array<double, N>& gradient,
                                 const Memory<Law>& memory) {
  if constexpr (memory_of<Law>() > 0) {
    return law.stress(gradient, memory);
  } else {
    return law.stress(gradient);
  }
}

/// Energy per volume that it stores [J/m^3]: the law's own, or that of a linear one.
template <class Law, std::size_t N>
double law_energy(const Law& law, const std::array<double, N>& gradient,
                  const Memory<Law>& memory) {
  if constexpr (memory_of<Law>() > 0) {
    return law.energy(gradient, memory);
  } else if constexpr (requires { law.energy(gradient); }) {
    return law.energy(gradient);
  } else {
    return 0.5 * dot(gradient, law.stress(gradient));
  }
}

/// A law at one point.
template <class Law>
struct LawAtPoint {
  const Law& law;
  Memory<Law> memory;

  template <std::size_t N>
  std::array<double, N> stress(const std::array<double, N>& gradient) const {
    return law_stress(law, gradient, memory);
  }
  double stabilisation() const { return law.stabilisation(); }
  double drained_bulk_modulus() const { return law.drained_bulk_modulus(); }
  decltype(auto) isotropic() const { return law.isotropic(); }
};

/// Laws by region, with what they remember at every point: all 0 at first.
template <class Law>
struct LawField {
  static constexpr int components = Law::components;

  LawByRegion<Law> laws;
  std::shared_ptr<std::vector<double>> memory;  ///< block by block of points

  explicit LawField(LawByRegion<Law> by_region)
      : laws(std::move(by_region)),
        memory(std::make_shared<std::vector<double>>(memory_of<Law>() * laws.law_of_point.size())) {
  }

  LawAtPoint<Law> at(Index i) const { return {laws.at(i), memory_at(i)}; }

  Memory<Law> memory_at(Index i) const {
    Memory<Law> own;
    for (std::size_t k = 0; k < own.size(); ++k) {
      own[k] = (*memory)[k * laws.law_of_point.size() + i];
    }
    return own;
  }
  void set_memory(Index i, const Memory<Law>& own) const {
    for (std::size_t k = 0; k < own.size(); ++k) {
      (*memory)[k * laws.law_of_point.size() + i] = own[k];
    }
  }
};

}  // namespace perifrac
