#pragma once

#include "modules/solid/material/material_type.hpp"

namespace perifrac {

/// Rock with reinforcement in one direction n, such as bolts: its energy per volume is
///   W = 1/2 E : C : E + 1/2 k (n . E n)^2,   E the strain,
/// with the rock's C and the stiffness k [Pa] that the reinforcement adds along n. Anisotropic and
/// linear: stress = C : E + k (n . E n) n (x) n.
template <int D>
struct Reinforced {
  static constexpr int components = D;

  IsotropicElasticity<D> rock;
  double stiffness;  ///< k [Pa]
  Vector<D> along;   ///< n

  /// From `material`, where `rock` is of the two elastic constants. Throws InputError.
  static Reinforced read(const Section& material, const IsotropicElasticity<D>& rock);

  /// Of a gradient of displacement, or of packets of them: of several points at once.
  template <class Number>
  std::array<Number, D * D> stress(const std::array<Number, D * D>& gradient) const {
    std::array<Number, D* D> result = rock.stress(gradient);
    Number extension{};
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) extension += (along[a] * along[b]) * gradient[a * D + b];
    }
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) {
        result[a * D + b] += (stiffness * along[a] * along[b]) * extension;
      }
    }
    return result;
  }

  double stabilisation() const { return rock.stabilisation(); }
  /// That of the rock: a bound from below, by which the coupling with pores judges its splits.
  double drained_bulk_modulus() const { return rock.drained_bulk_modulus(); }
  const IsotropicElasticity<D>& isotropic() const { return rock; }
};

/// `solid.material.type: reinforced`.
MaterialType reinforced_material();

}  // namespace perifrac
