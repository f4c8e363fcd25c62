#pragma once

#include "core/base/small_vector.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// Linear elasticity by any stiffness: that of another law at rest.
template <int D>
struct TangentLaw {
  static constexpr int components = D;

  std::array<std::array<double, D * D>, D * D> columns;  ///< stress of a unit gradient [Pa]
  IsotropicElasticity<D> rock;
  double bonds;  ///< stabilisation [Pa]

  /// By central differences, exact for laws without terms of even order.
  template <class Law>
  static TangentLaw of(const Law& law) {
    constexpr double step = 1e-6;
    TangentLaw tangent{{}, law.isotropic(), law.stabilisation()};
    for (int k = 0; k < D * D; ++k) {
      Tensor<D, D> forth{}, back{};
      forth[k] = step;
      back[k] = -step;
      tangent.columns[k] = (law.stress(forth) - law.stress(back)) / (2.0 * step);
    }
    return tangent;
  }

  std::array<double, D * D> stress(const std::array<double, D * D>& gradient) const {
    std::array<double, D * D> result{};
    for (int k = 0; k < D * D; ++k) result += gradient[k] * columns[k];
    return result;
  }
  double stabilisation() const { return bonds; }
  double drained_bulk_modulus() const { return rock.drained_bulk_modulus(); }
  const IsotropicElasticity<D>& isotropic() const { return rock; }
};

}  // namespace perifrac
