#pragma once

#include <memory>

#include "modules/solid/isotropic_elasticity.hpp"
#include "modules/solid/linear_exact_elasticity.hpp"
#include "modules/solid/solid_boundary.hpp"

namespace perifrac::test {

/// A uniform linear-exact material on the families that the boundary asks for.
template <int D>
LinearExactElasticity<D, IsotropicElasticity<D>> elastic(const Body<D>& body,
                                                         const SolidBoundary<D>& boundary,
                                                         IsotropicElasticity<D> law) {
  const auto family = body.family(boundary.mirrored());
  return LinearExactElasticity<D, IsotropicElasticity<D>>(
      {family, boundary.mirror_condition(*family), law});
}

}  // namespace perifrac::test
