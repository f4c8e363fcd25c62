#pragma once

#include <cmath>

#include "core/base/small_vector.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac::test {

/// Associated plastic flow of the deviator with kinematic hardening, which an elastic predictor and
/// one return solve exactly along a straight path. It remembers the plastic strain, traceless.
template <int D>
struct Hardening {
  static constexpr int components = D;
  static constexpr std::size_t memory = D * D;
  using Gradient = Tensor<D, D>;

  IsotropicElasticity<D> rock;
  double yield;      ///< length of the deviator of stress [Pa]
  double hardening;  ///< back stress over plastic strain [Pa]

  static Gradient deviator(const Gradient& g) {
    Gradient e{};
    double trace = 0.0;
    for (int a = 0; a < D; ++a) trace += g[a * D + a];
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) e[a * D + b] = 0.5 * (g[a * D + b] + g[b * D + a]);
      e[a * D + a] -= trace / D;
    }
    return e;
  }
  /// Plastic strain that is new at this gradient.
  Gradient flow(const Gradient& g, const Gradient& plastic) const {
    const Gradient driving =
        2.0 * rock.shear_modulus * (deviator(g) - plastic) - hardening * plastic;
    const double size = std::sqrt(squared_norm(driving));
    if (size <= yield) return {};
    return ((size - yield) / (2.0 * rock.shear_modulus + hardening) / size) * driving;
  }
  Gradient stress(const Gradient& g, const Gradient& plastic) const {
    return rock.stress(g) - 2.0 * rock.shear_modulus * (plastic + flow(g, plastic));
  }
  double energy(const Gradient& g, const Gradient& plastic) const {
    return 0.5 * dot(g, rock.stress(g)) - 2.0 * rock.shear_modulus * dot(plastic, deviator(g)) +
           (rock.shear_modulus + 0.5 * hardening) * squared_norm(plastic);
  }
  double follow(const Gradient& g, Gradient& plastic, double) const {
    const Gradient more = flow(g, plastic);
    plastic += more;
    return yield * std::sqrt(squared_norm(more));
  }
  double stabilisation() const { return rock.stabilisation(); }
  double drained_bulk_modulus() const { return rock.drained_bulk_modulus(); }
  double stiffening() const { return 1.0; }
  const IsotropicElasticity<D>& isotropic() const { return rock; }
};

/// Stores 1/2 F : C : F + 1/4 c |E|^4, E the strain.
template <int D>
struct Stiffening {
  static constexpr int components = D;
  static constexpr bool is_linear = false;
  using Gradient = Tensor<D, D>;

  IsotropicElasticity<D> rock;
  double more;  ///< c [Pa]

  static Gradient strain(const Gradient& g) {
    Gradient e;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) e[a * D + b] = 0.5 * (g[a * D + b] + g[b * D + a]);
    }
    return e;
  }
  Gradient stress(const Gradient& g) const {
    const Gradient e = strain(g);
    return rock.stress(g) + (more * squared_norm(e)) * e;
  }
  double energy(const Gradient& g) const {
    const double square = squared_norm(strain(g));
    return 0.5 * dot(g, rock.stress(g)) + 0.25 * more * square * square;
  }
  double stabilisation() const { return rock.stabilisation(); }
  double drained_bulk_modulus() const { return rock.drained_bulk_modulus(); }
  double stiffening() const { return 2.0; }
  const IsotropicElasticity<D>& isotropic() const { return rock; }
};

}  // namespace perifrac::test
