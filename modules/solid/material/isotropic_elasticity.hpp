#pragma once

#include <string>

#include "core/base/small_vector.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Isotropic linear elasticity, plane strain in 2D; the law of the linear-exact operator.
template <int D>
struct IsotropicElasticity {
  static constexpr int components = D;

  double lame_lambda;    ///< [Pa]
  double shear_modulus;  ///< [Pa]

  /// C : F = lambda tr(F) I + mu (F + F^T); also of packets of gradients.
  template <class Number>
  std::array<Number, D * D> stress(const std::array<Number, D * D>& gradient) const {
    Number dilatation{};
    for (int a = 0; a < D; ++a) dilatation += gradient[a * D + a];
    std::array<Number, D * D> result;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) {
        result[a * D + b] = shear_modulus * (gradient[a * D + b] + gradient[b * D + a]);
      }
      result[a * D + a] += lame_lambda * dilatation;
    }
    return result;
  }

  /// 2 mu: a bond that does not follow its points' gradients costs as much as shear.
  double stabilisation() const { return 2.0 * shear_modulus; }

  /// Stiffness against a change of volume at fixed mean stress [Pa]: lambda + mu in plane strain,
  /// the bulk modulus in 3D. What a pore stress makes of dilatation, locally.
  double drained_bulk_modulus() const { return lame_lambda + 2.0 * shear_modulus / D; }

  /// E' = E / (1 - nu^2) [Pa].
  double plane_strain_modulus() const {
    return 4.0 * shear_modulus * (lame_lambda + shear_modulus) /
           (lame_lambda + 2.0 * shear_modulus);
  }
};

/// The keys of `material` for an isotropic elastic solid, of which two elastic constants are given.
KeyTable elastic_constant_keys();

/// Reads the two constants under `path`; throws InputError.
template <int D>
IsotropicElasticity<D> read_isotropic_elasticity(const Section& section,
                                                 const std::string& path = "material");

}  // namespace perifrac
