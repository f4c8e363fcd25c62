#pragma once

#include "core/base/small_vector.hpp"

namespace perifrac {

/// Isotropic Darcy flow, the law of the linear-exact operator: the operator's energy is half the
/// power that the flow dissipates.
template <int D>
struct DarcyLaw {
  static constexpr int components = 1;

  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]

  /// Also of packets of gradients.
  template <class Number>
  std::array<Number, D> stress(const std::array<Number, D>& gradient) const {
    std::array<Number, D> result;
    for (int a = 0; a < D; ++a) result[a] = gradient[a] * mobility;
    return result;
  }

  double mean_mobility() const { return mobility; }

  /// 4 D / 3 cancels the leading error of the nonlocal gradient: about fourth order inside.
  double stabilisation() const { return 4.0 * D / 3.0 * mobility; }

  /// Of the bonds of a family that does not span space (bond_flow.hpp).
  double bonds_alone() const { return D * mobility; }
};

}  // namespace perifrac
