#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// Linear elasticity by any stiffness: that of another law at one gradient of displacement.
template <int D>
struct TangentLaw {
  static constexpr int components = D;

  std::array<Tensor<D, D>, D * D> columns;  ///< stress of a unit gradient [Pa]
  IsotropicElasticity<D> rock;
  double bonds;  ///< stabilisation [Pa]

  /// By central differences, made symmetric.
  template <class Law>
  static TangentLaw of(const Law& law, const Tensor<D, D>& gradient = {}) {
    const double step = 1e-6 * std::max(1e-3, std::sqrt(squared_norm(gradient)));
    TangentLaw tangent{{}, law.isotropic(), law.stabilisation()};
    for (int k = 0; k < D * D; ++k) {
      Tensor<D, D> forth = gradient, back = gradient;
      forth[k] += step;
      back[k] -= step;
      tangent.columns[k] = (law.stress(forth) - law.stress(back)) / (forth[k] - back[k]);
    }
    for (int k = 0; k < D * D; ++k) {
      for (int l = 0; l < k; ++l) {
        const double mean = 0.5 * (tangent.columns[k][l] + tangent.columns[l][k]);
        tangent.columns[k][l] = tangent.columns[l][k] = mean;
      }
    }
    return tangent;
  }

  Tensor<D, D> stress(const Tensor<D, D>& gradient) const {
    Tensor<D, D> result{};
    for (int k = 0; k < D * D; ++k) result += gradient[k] * columns[k];
    return result;
  }
  double stabilisation() const { return bonds; }
  double drained_bulk_modulus() const { return rock.drained_bulk_modulus(); }
  const IsotropicElasticity<D>& isotropic() const { return rock; }
};

/// One for each point.
template <int D>
struct TangentField {
  static constexpr int components = D;

  std::vector<TangentLaw<D>> of_point;

  const TangentLaw<D>& at(Index i) const { return of_point[i]; }
};

}  // namespace perifrac
