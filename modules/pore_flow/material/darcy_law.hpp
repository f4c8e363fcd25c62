#pragma once

#include "core/base/small_vector.hpp"

namespace perifrac {

/// Isotropic Darcy flow, the law of the linear-exact operator: the operator's energy is half the
/// power that the flow dissipates.
template <int D>
struct DarcyLaw {
  static constexpr int components = 1;

  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]

  Tensor<1, D> stress(const Tensor<1, D>& gradient) const { return mobility * gradient; }

  double mean_mobility() const { return mobility; }

  /// 4 D / 3 cancels the leading error of the nonlocal gradient: about fourth order inside.
  double stabilisation() const { return 4.0 * D / 3.0 * mobility; }

  /// Of the bonds of a family that does not span space (bond_flow.hpp).
  double bonds_alone() const { return D * mobility; }
};

}  // namespace perifrac
